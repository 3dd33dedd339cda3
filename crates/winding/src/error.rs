//! The faults of a winding's specification.

/// Errors of this crate. Every message names the field of [`Spec`](crate::Spec), its value and the remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A length is not a number, not finite, or has the wrong sign.
    #[error("{field} = {value} m, but it must be a finite length {range}")]
    Length {
        /// Name of the field.
        field: &'static str,
        /// Its value \[m\].
        value: f64,
        /// The valid range, in words.
        range: &'static str,
    },
    /// There is no layer to wind.
    #[error("layers = 0, but a coil has at least one layer")]
    NoLayers,
    /// The even layers do not fit the grooves between the turns of the odd ones.
    #[error(
        "turns_even_layers = {even} does not fit turns_odd_layers = {odd}: an even layer sits in the grooves of the odd ones; \
         set it to {odd} or to one less"
    )]
    EvenTurns {
        /// Turns in each odd layer.
        odd: usize,
        /// Turns in each even layer.
        even: usize,
    },
    /// A layer has too few turns for its pattern.
    #[error(
        "layer {layer} has {}, but this pattern needs at least {needed} a layer; raise turns_odd_layers and turns_even_layers",
        turns_of(*turns as i64)
    )]
    TooFewTurns {
        /// The layer, counted from 1.
        layer: usize,
        /// Its turns.
        turns: usize,
        /// The least number of turns.
        needed: usize,
    },
    /// The layer of a defect does not exist.
    #[error("the defect's layer = {layer}, but the coil has layers 1 to {layers}")]
    DefectLayer {
        /// The layer that was named.
        layer: usize,
        /// Layers of the coil.
        layers: usize,
    },
    /// A defect leaves no turn, or more than twice as many as designed.
    #[error(
        "a defect of {} in layer {layer}, where its owner lays {owned}; leave at least one turn and at most twice as many",
        turns_of(i64::from(*turns))
    )]
    DefectTurns {
        /// The layer, counted from 1.
        layer: usize,
        /// Turns too many or missing.
        turns: i32,
        /// Turns that the layer's owner should lay.
        owned: usize,
    },
    /// The turn table would be too large.
    #[error(
        "layers = {layers} with turns_odd_layers = {odd} and turns_even_layers = {even} make more than {limit} turns, \
         the most that is wound; lower one of them"
    )]
    TooManyTurns {
        /// Number of layers.
        layers: usize,
        /// Turns in each odd layer.
        odd: usize,
        /// Turns in each even layer.
        even: usize,
        /// The limit, [`MAX_TURNS`](crate::MAX_TURNS).
        limit: usize,
    },
    /// The fibre is so long that its weights \[m²\] overflow.
    #[error("the fibre would be {length:e} m long, too long to square; lower inner_radius, pitch or tails")]
    TooLong {
        /// Length of the fibre with tails \[m\].
        length: f64,
    },
}

/// A number of turns with its noun.
fn turns_of(count: i64) -> String {
    if count.abs() == 1 { format!("{count} turn") } else { format!("{count} turns") }
}
