//! Standard output, without complaint when its reader has left.

use std::io::{self, ErrorKind, Write};

use fogcoil::Error;

/// Writes to standard output; a reader that has left is no error.
pub(crate) fn print(text: &str) -> Result<(), Error> {
    let mut stdout = io::stdout().lock();
    let written = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush());
    written.or_else(|error| if error.kind() == ErrorKind::BrokenPipe { Ok(()) } else { Err(Error::Stdout(error)) })
}
