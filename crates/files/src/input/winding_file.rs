//! The winding of `COIL.ron`: as it is written, and laid turn by turn.

use coil::Side;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use winding::{ClimbSide, LayerDefect, Pattern, Spec, Tails, TurnLength, Winding};

use super::InputError;
use super::group::Group;
use super::mirror::{Mirror, mirror, mirror_choice};
use super::quantity::{LengthMm, PitchMm, TailM};

const MOST_LAYERS: usize = 10_000;
const MOST_TURNS: usize = 100_000;

/// How the fibre lies.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WindingFile {
    /// Which layer belongs to which half.
    pub(crate) pattern: PatternFile,
    /// Number of layers, 1 to 10000.
    pub(crate) layers: usize,
    /// Turns of layers 1, 3, 5, ..., 1 to 100000.
    pub(crate) turns_odd_layers: usize,
    /// Turns of layers 2, 4, 6, ...: as many, or one fewer.
    pub(crate) turns_even_layers: usize,
    /// Radius on which the first layer lies.
    pub(crate) inner_radius_mm: LengthMm,
    /// Distance of neighbouring turns.
    pub(crate) pitch_mm: PitchMm,
    /// Side at which the CW half passes from layer to layer; Right is +y.
    pub(crate) cw_climbs: SideFile,
    /// True: 2 pi r; Equal: every turn the mean length.
    pub(crate) turn_length: TurnLengthFile,
    /// Bare fibre beyond the winding.
    pub(crate) tails_m: TailsFile,
    /// A layer wound wrongly; None unless given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) defect: Option<DefectFile>,
}

/// A layer wound wrongly.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DefectFile {
    /// Which, from 1, outwards.
    pub(crate) layer: usize,
    /// Turns too many, or if negative too few, of the half that owns the layer.
    pub(crate) turns: i32,
}

/// Which layer belongs to which half.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(crate) enum PatternFile {
    Cylindrical,
    Dipole,
    Quadrupole,
    PracticalQuadrupole,
    Octupole,
}

/// An end of the coil: Left is y = 0, Right +y.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy)]
pub(crate) enum SideFile {
    Left,
    Right,
}

/// How long a turn is.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(crate) enum TurnLengthFile {
    True,
    Equal,
}

/// Bare fibre beyond the winding, at the temperature of the hub's bore.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TailsFile {
    /// At the CW half's outer end.
    pub(crate) cw: TailM,
    /// At the CCW half's outer end.
    pub(crate) ccw: TailM,
}

mirror!(WindingFile is Spec {
    pattern = pattern,
    layers = layers,
    turns_odd_layers = turns_odd_layers,
    turns_even_layers = turns_even_layers,
    inner_radius_mm = inner_radius,
    pitch_mm = pitch,
    cw_climbs = cw_climbs,
    turn_length = turn_length,
    tails_m = tails,
    defect = defect,
});
mirror!(DefectFile is LayerDefect { layer = layer, turns = turns });
mirror!(TailsFile is Tails { cw = cw, ccw = ccw });
mirror_choice!(PatternFile is Pattern { Cylindrical, Dipole, Quadrupole, PracticalQuadrupole, Octupole });
mirror_choice!(SideFile is Side { Left, Right });
mirror_choice!(SideFile is ClimbSide { Left, Right });
mirror_choice!(TurnLengthFile is TurnLength { True, Equal });

/// Lays the turns.
pub(super) fn winding(at: &Group, file: &WindingFile) -> Result<Winding, InputError> {
    at.count("layers", file.layers, MOST_LAYERS)?;
    at.count("turns_odd_layers", file.turns_odd_layers, MOST_TURNS)?;
    winding::wind(&file.model()).map_err(|error| at.fault(field(&error), error.to_string(), ""))
}

fn field(error: &winding::Error) -> &'static str {
    use winding::Error::{DefectLayer, DefectTurns, EvenTurns, Length, NoLayers, TooFewTurns, TooLong, TooManyTurns};
    match error {
        Length { field, .. } => field,
        EvenTurns { .. } => "turns_even_layers",
        TooFewTurns { layer, .. } if layer % 2 == 0 => "turns_even_layers",
        TooFewTurns { .. } => "turns_odd_layers",
        DefectLayer { .. } | DefectTurns { .. } => "defect",
        NoLayers | TooManyTurns { .. } => "layers",
        TooLong { .. } => "inner_radius_mm",
        _ => "",
    }
}
