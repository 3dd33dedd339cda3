//! Progress of long work: a task, its finished part, and its whole.
//!
//! A library that works long takes a callback, `&dyn Fn(Step)`, and calls it as each task begins and, where the task can be counted, again
//! and again while it goes on. What is shown of that is the caller's affair.

/// A moment of long work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step<'a> {
    /// The task, in words for people.
    pub task: &'a str,
    /// Number of its finished parts, and of all; `None` for a task that cannot be counted.
    pub done: Option<(usize, usize)>,
}

/// The task and, of one that is counted, how far it is: `solving (3 of 8)`.
impl std::fmt::Display for Step<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self.done {
            Some((done, of)) => write!(f, "{} ({done} of {of})", self.task),
            None => f.write_str(self.task),
        }
    }
}

impl<'a> Step<'a> {
    /// A task begins.
    pub const fn begins(task: &'a str) -> Self {
        Self { task, done: None }
    }

    /// `done` parts `of` a task are done.
    pub const fn counted(task: &'a str, done: usize, of: usize) -> Self {
        Self { task, done: Some((done, of)) }
    }

    /// The share that is done, from 0 to 1; `None` of a task that cannot be counted.
    pub fn share(self) -> Option<f64> {
        self.done.map(|(done, of)| if of == 0 { 1.0 } else { done as f64 / of as f64 })
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(test)]
mod tests {
    use super::Step;

    #[test]
    fn exact_shares() {
        assert_eq!(Step::begins("a").share(), None);
        assert_eq!(Step::counted("a", 3, 4).share(), Some(0.75));
        assert_eq!(Step::counted("nothing to do", 0, 0).share(), Some(1.0));
        assert_eq!([Step::begins("a"), Step::counted("a", 3, 4)].map(|step| step.to_string()), ["a", "a (3 of 4)"]);
    }
}
