//! Units that conceal something, made by a plant of their own, for the diagnosis to be tried on.
//!
//! The generator shares with the diagnosis the assembly of matrices, the adjoint of the bias and the reference coil; its own are the mesh, the
//! space of thermal modes, the integrator, the laws of stiffness, bonds, thermometer and optics, the changes of the design, the noise and the
//! matched filter. Constants are off by what no mesh resolves.
//!
//! It is independent on purpose: it names neither the mechanisms nor the diagnosis, nor what conditions recordings, nor the program; of `coil`
//! it takes designs and what is assembled from them, and none of the reduced models and integrators that the diagnosis fits with. A test reads
//! the sources and holds them to that.

mod build;
mod chamber;
mod drawn;
mod effect;
mod heat;
mod law;
mod laws;
mod matched;
mod noise;
mod ordinary;
mod outside;
mod plant;
mod production;
mod random;
mod record;
mod scene;
mod unit;

#[cfg(test)]
mod tests;

pub(crate) use drawn::{DrawnUnit, DrawnUnits};
pub(crate) use noise::SPAN;
pub(crate) use ordinary::{NOTHING, Ordinary};
pub use production::{Produced, production};
pub use random::Random;
pub(crate) use record::THERMOMETER;
pub use unit::{Generator, Unit, Which};

use sha2::{Digest, Sha256};

/// Sources that make the units, by file.
const SOURCES: [(&str, &str); 18] = [
    ("build.rs", include_str!("build.rs")),
    ("chamber.rs", include_str!("chamber.rs")),
    ("drawn.rs", include_str!("drawn.rs")),
    ("effect.rs", include_str!("effect.rs")),
    ("heat.rs", include_str!("heat.rs")),
    ("law.rs", include_str!("law.rs")),
    ("laws.rs", include_str!("laws.rs")),
    ("matched.rs", include_str!("matched.rs")),
    ("noise.rs", include_str!("noise.rs")),
    ("ordinary.rs", include_str!("ordinary.rs")),
    ("outside.rs", include_str!("outside.rs")),
    ("plant.rs", include_str!("plant.rs")),
    ("production.rs", include_str!("production.rs")),
    ("random.rs", include_str!("random.rs")),
    ("record.rs", include_str!("record.rs")),
    ("scene.rs", include_str!("scene.rs")),
    ("unit.rs", include_str!("unit.rs")),
    ("coil-reference.ron", include_str!("../../../../fixtures/coil-reference.ron")),
];

/// SHA-256 of the generator's sources, to tell its units from those of another.
pub(crate) fn fingerprint() -> String {
    crate::program::hex(SOURCES.iter().fold(Sha256::new(), |hash, (_, source)| hash.chain_update(source)))
}
