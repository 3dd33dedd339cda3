//! All tests of the crate in one program: linked once.

mod carried;
mod common;
mod compose;
mod elsewhere;
mod exact_evidence;
mod hidden;
mod kept;
mod late;
mod real_recordings;
mod refused;
mod rivals;
mod sampled;
mod search;
mod separation;
mod spectrum;
mod starts;
mod toy;
mod valleys;
mod whitened;
