//! A design as the coil's case file, so that it reads back as it was.

use coil::Design;
use ron::ser::{PrettyConfig, to_string_pretty};

use crate::input::CoilFile;

/// Groups nested deeper than this stand on one line.
const LINES: usize = 2;

/// The content of a coil file for `design`, with `comments` above it, a line each.
///
/// Every number reads back to the same double; one that no decimal in the file's unit gives, to a neighbour of it.
pub fn coil_file(name: &str, design: &Design, comments: &[String]) -> String {
    let layout = PrettyConfig::new().depth_limit(LINES).new_line("\n");
    // the types of a coil file have nothing that RON cannot say
    let text = to_string_pretty(&CoilFile::new(name, design), layout).unwrap_or_default();
    let comments = comments.iter().flat_map(|comment| comment.lines()).map(|line| format!("// {line}\n"));
    comments.chain([text, "\n".to_owned()]).collect()
}
