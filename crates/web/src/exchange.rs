//! Exchange of texts with a page: it writes the question into memory of this module, calls, and reads the answer there.
//!
//! WebAssembly passes numbers alone. Therefore the two texts lie in memory that belongs to the module, the one piece of global state of the whole
//! workspace: [`room`] makes place for a question and says where, [`ask`] puts the answer in the question's place. A page is one thread; natively a lock
//! keeps two from mixing their texts.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// The question, then its answer.
static TEXT: Mutex<Vec<u8>> = Mutex::new(Vec::new());

fn text() -> MutexGuard<'static, Vec<u8>> {
    TEXT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes place for a text of so many bytes; where it is. It holds zeros until the page has written there.
#[expect(unsafe_code, reason = "the name under which a page finds it; no other function has it")]
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *const u8 {
    let mut text = text();
    *text = vec![0; bytes];
    text.as_ptr()
}

/// Answers the question that was written into [`room`]; where the answer is. Its length is [`length`].
#[expect(unsafe_code, reason = "the name under which a page finds it; no other function has it")]
#[unsafe(no_mangle)]
pub extern "C" fn ask() -> *const u8 {
    let mut text = text();
    let answer = crate::answer(&String::from_utf8_lossy(&text));
    *text = answer.into_bytes();
    text.as_ptr()
}

/// The length of the answer in bytes.
#[expect(unsafe_code, reason = "the name under which a page finds it; no other function has it")]
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    text().len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_lies_where_the_question_was() {
        assert!(!room(3).is_null());
        assert_eq!(*text(), [0; 3]);
        text().copy_from_slice(b"abc");
        assert!(!ask().is_null());
        let answer = String::from_utf8(text().clone()).unwrap();
        assert!(answer.starts_with("{\"error\":\"the question cannot be read"), "{answer}");
        assert_eq!(length(), answer.len());
    }
}
