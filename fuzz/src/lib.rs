//! Every reader of text, fed with bytes that a fuzzer makes: `cargo xtask fuzz` guides it by the code that it reaches; the tests run the kept corpus
//! (`src/__fuzz__`) and a second of chance.

#[cfg(test)]
mod readers;
