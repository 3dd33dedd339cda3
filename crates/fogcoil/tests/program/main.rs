//! The program and its library from outside: one test program, so that the library is linked once.

#![allow(clippy::unwrap_used)] // helpers of tests

mod bad_diagnosis;
mod bad_extremes;
mod bad_input;
mod bad_instants;
mod bad_profile;
mod bad_record;
mod band;
mod batch;
mod cache;
mod calibrate;
mod cell_general;
mod check;
mod check_impossible;
mod common;
mod compare;
mod diagnose;
mod good_input;
mod identify;
mod loggers;
mod measure;
mod model_out;
mod mutated_input;
mod optimise;
mod outputs;
mod own_mechanism;
mod recommend;
mod report;
mod section;
mod simulate;
mod spool;
mod sweep;
mod terminal;
mod white_noise;
mod write_map;
