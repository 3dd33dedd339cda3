//! Units that a generator of the project's own conceals something in.

mod chamber;
mod effect;
mod heat;
mod law;
mod matched;
mod noise;
mod outside;
mod plant;
mod random;
mod record;
mod sheet;
mod unit;

#[cfg(test)]
mod tests;
