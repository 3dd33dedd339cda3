//! Tests of the whole chain live beside this file, one target a subject.
