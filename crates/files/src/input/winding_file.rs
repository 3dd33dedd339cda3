//! The winding of `COIL.ron`: as it is written, and laid turn by turn.

use coil::Side;
use winding::{ClimbSide, LayerDefect, Pattern, Spec, Tails, TurnLength, Winding};

use super::InputError;
use super::group::Group;
use super::mirror::{Mirror, mirrored, mirrored_choice, says_default};
use super::quantity::{LengthMm, PitchMm, PositionMm, TailM};

const MOST_LAYERS: usize = 10_000;
const MOST_TURNS: usize = 100_000;

mirrored! {
    /// Places of the turns.
    WindingFile is Spec {
        /// The half of each layer.
        pattern: PatternFile = pattern,
        /// Number of layers, 1 to 10000.
        #[schemars(range(min = 1, max = 10000))]
        layers: usize = layers,
        /// Turns of layers 1, 3, 5, ..., 1 to 100000.
        #[schemars(range(min = 1, max = 100000))]
        turns_odd_layers: usize = turns_odd_layers,
        /// Turns of layers 2, 4, 6, ...: as many, or one fewer.
        turns_even_layers: usize = turns_even_layers,
        /// Inner radius of the wound coil: outer radius of the hub, plus any gap; the first layer lies on it.
        inner_radius_mm: LengthMm = inner_radius,
        /// Distance of neighbouring turns.
        pitch_mm: PitchMm = pitch,
        /// Axial place at which the winding begins, from the coil's left face; 0 unless given.
        #[serde(default, skip_serializing_if = "says_default::<f64, _>")]
        start_mm: PositionMm = start,
        /// Axial place at which it ends, its turns spread evenly; None, where turns touch, unless given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        end_mm: Option<PositionMm> = end,
        /// Side at which the CW half passes from layer to layer; Right is +y.
        cw_climbs: SideFile = cw_climbs,
        /// True: 2 pi r; Equal: every turn the mean length.
        turn_length: TurnLengthFile = turn_length,
        /// Bare fibre beyond the winding.
        tails_m: TailsFile = tails,
        /// A layer wound wrongly; None unless given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        defect: Option<DefectFile> = defect,
    }

    /// A layer wound wrongly.
    DefectFile is LayerDefect {
        /// Its number, from 1, outwards.
        #[schemars(range(min = 1, max = 10000))]
        layer: usize = layer,
        /// Turns too many, or if negative too few, of the half that owns the layer.
        turns: i32 = turns,
    }

    /// Bare fibre beyond the winding, at the temperature of the hub's bore.
    TailsFile is Tails {
        /// Tail at the CW half's outer end.
        cw: TailM = cw,
        /// Tail at the CCW half's outer end.
        ccw: TailM = ccw,
    }
}

mirrored_choice! {
    /// The half of each layer.
    PatternFile is Pattern: { Cylindrical, Dipole, Quadrupole, PracticalQuadrupole, Octupole }

    /// An end of the coil: Left is y = 0, Right +y.
    SideFile is Side, ClimbSide: { Left, Right }

    /// Length of a turn.
    TurnLengthFile is TurnLength: { True, Equal }
}

/// Lays the turns.
pub(super) fn winding(at: &Group, file: &WindingFile) -> Result<Winding, InputError> {
    at.count("layers", file.layers, MOST_LAYERS)?;
    at.count("turns_odd_layers", file.turns_odd_layers, MOST_TURNS)?;
    winding::wind(&file.model()).map_err(|error| at.fault(field(&error), error.to_string(), ""))
}

fn field(error: &winding::Error) -> &'static str {
    use winding::Error::{DefectLayer, DefectTurns, EvenTurns, Length, NoLayers, TooFewTurns, TooLong, TooManyTurns};
    match error {
        Length { field: "start", .. } => "start_mm",
        Length { field: "end", .. } => "end_mm",
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
