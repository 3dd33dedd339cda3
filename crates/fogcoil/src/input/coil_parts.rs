//! The parts of a coil file, each checked and turned into SI.

use bias::units::DEG_PER_H_PER_RAD_PER_S;
use bias::{Optics, StrainConvention};
use coil::{Contact, Drifts, Flange, Sensor, Side, Solid, Spool, Surroundings};
use fem_core::material::Isotropic;
use winding::{ClimbSide, LayerDefect, Pattern, Spec, Tails, TurnLength, Winding};

use super::InputError;
use super::coil_file::{
    BodyFile, DriftsFile, FlangeFile, OpticsFile, PatternFile, SensorFile, SideFile, SolidFile, SpoolFile, StrainFile,
    SurroundingsFile, TurnLengthFile, WindingFile,
};
use super::limits::{
    CONDUCTIVITY, CURVATURE_PER_K2, DENSITY, DRIFT_DEG_PER_H_PER_K, EXPANSION_PER_K, EXTRA_LENGTH_MM, Group, INDEX, LAG_S,
    LENGTH_MM, MODULUS_GPA, PHOTOELASTIC, PITCH_MM, POSITION_MM, SPECIFIC_HEAT, TAIL_M, TEMPERATURE_C,
};
use crate::units::{from_gpa, from_mm, to_mm};

const MOST_LAYERS: usize = 10_000;
const MOST_TURNS: usize = 100_000;
/// How far the winding may reach beyond the coil's rectangle, in pitches: drawings round to hundredths of a millimetre.
const SLACK: f64 = 0.1;

pub(crate) fn winding(at: &Group, file: &WindingFile) -> Result<Winding, InputError> {
    let tails = at.group("tails_m");
    let spec = Spec {
        pattern: match file.pattern {
            PatternFile::Cylindrical => Pattern::Cylindrical,
            PatternFile::Dipole => Pattern::Dipole,
            PatternFile::Quadrupole => Pattern::Quadrupole,
            PatternFile::PracticalQuadrupole => Pattern::PracticalQuadrupole,
            PatternFile::Octupole => Pattern::Octupole,
        },
        layers: at.count("layers", file.layers, MOST_LAYERS)?,
        turns_odd_layers: at.count("turns_odd_layers", file.turns_odd_layers, MOST_TURNS)?,
        turns_even_layers: file.turns_even_layers,
        inner_radius: from_mm(at.number("inner_radius_mm", file.inner_radius_mm, &LENGTH_MM)?),
        pitch: from_mm(at.number("pitch_mm", file.pitch_mm, &PITCH_MM)?),
        cw_climbs: match file.cw_climbs {
            SideFile::Left => ClimbSide::Left,
            SideFile::Right => ClimbSide::Right,
        },
        turn_length: match file.turn_length {
            TurnLengthFile::True => TurnLength::True,
            TurnLengthFile::Equal => TurnLength::Equal,
        },
        tails: Tails { cw: tails.number("cw", file.tails_m.cw, &TAIL_M)?, ccw: tails.number("ccw", file.tails_m.ccw, &TAIL_M)? },
        defect: file.defect.as_ref().map(|d| LayerDefect { layer: d.layer, turns: d.turns }),
    };
    winding::wind(&spec).map_err(|error| at.fault(winding_field(&error), error.to_string(), ""))
}

fn winding_field(error: &winding::Error) -> &'static str {
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

/// Checks the coil's rectangle against its winding.
pub(crate) fn check_rectangle(at: &Group, file: &BodyFile, winding: &Winding) -> Result<(), InputError> {
    let inner = to_mm(winding.spec().inner_radius);
    at.number("outer_radius_mm", file.outer_radius_mm, &LENGTH_MM)?;
    at.number("height_mm", file.height_mm, &LENGTH_MM)?;
    if file.outer_radius_mm <= inner {
        let problem = format!("{} mm is not greater than winding.inner_radius_mm, {inner} mm", file.outer_radius_mm);
        return Err(at.fault("outer_radius_mm", problem, "give the radius, not the thickness, of the wound coil"));
    }
    let slack = SLACK * to_mm(winding.spec().pitch);
    let extents =
        [("outer_radius_mm", file.outer_radius_mm, winding.outer_radius()), ("height_mm", file.height_mm, winding.height())];
    for (key, given, wound) in extents {
        let wound = to_mm(wound);
        if wound > given + slack {
            let problem = format!("the winding reaches {wound:.4} mm, outside the coil's {given} mm");
            let remedy = format!("set it to {wound:.4} or more, or check layers, turns and pitch_mm");
            return Err(at.fault(key, problem, remedy));
        }
    }
    Ok(())
}

pub(crate) fn spool(at: &Group, file: &SpoolFile, inner_radius: f64) -> Result<Spool, InputError> {
    let hub_contact = contact(file.hub_bonded);
    let room = to_mm(inner_radius - hub_contact.gap());
    at.number("hub_thickness_mm", file.hub_thickness_mm, &LENGTH_MM)?;
    if file.hub_thickness_mm >= room {
        let problem = format!("{} mm leaves no bore inside the coil's inner radius", file.hub_thickness_mm);
        return Err(at.fault("hub_thickness_mm", problem, format!("make it less than {room} mm")));
    }
    let mut flanges: Vec<Flange> = Vec::new();
    for (i, file) in file.flanges.iter().enumerate() {
        let at = at.group(&format!("flanges[{i}]"));
        let flange = flange(&at, file)?;
        if flanges.iter().any(|other| other.side == flange.side) {
            let problem = format!("a second flange at the side {:?}", flange.side);
            return Err(at.fault("side", problem, "give at most one flange a side, or set the other side"));
        }
        flanges.push(flange);
    }
    let material = solid(&at.group("material"), &file.material)?;
    Ok(Spool { material, hub_thickness: from_mm(file.hub_thickness_mm), hub_contact, flanges })
}

fn flange(at: &Group, file: &FlangeFile) -> Result<Flange, InputError> {
    Ok(Flange {
        side: side(file.side),
        thickness: from_mm(at.number("thickness_mm", file.thickness_mm, &LENGTH_MM)?),
        overhang: from_mm(at.number("overhang_mm", file.overhang_mm, &EXTRA_LENGTH_MM)?),
        contact: contact(file.bonded),
    })
}

pub(crate) fn side(file: SideFile) -> Side {
    match file {
        SideFile::Left => Side::Left,
        SideFile::Right => Side::Right,
    }
}

fn contact(bonded: bool) -> Contact {
    if bonded { Contact::Bonded } else { Contact::Gap }
}

fn solid(at: &Group, file: &SolidFile) -> Result<Solid, InputError> {
    let elastic = Isotropic {
        youngs_modulus: from_gpa(at.number("youngs_modulus_gpa", file.youngs_modulus_gpa, &MODULUS_GPA)?),
        poisson_ratio: file.poisson_ratio,
        thermal_expansion: at.number("thermal_expansion_per_k", file.thermal_expansion_per_k, &EXPANSION_PER_K)?,
    };
    at.law(elastic.law())?;
    Ok(Solid {
        elastic,
        conductivity: at.number("conductivity_w_per_mk", file.conductivity_w_per_mk, &CONDUCTIVITY)?,
        density: at.number("density_kg_per_m3", file.density_kg_per_m3, &DENSITY)?,
        specific_heat: at.number("specific_heat_j_per_kgk", file.specific_heat_j_per_kgk, &SPECIFIC_HEAT)?,
    })
}

pub(crate) fn surroundings(at: &Group, file: &SurroundingsFile) -> Result<Surroundings, InputError> {
    let (medium, of) = (&file.medium, at.group("medium"));
    Ok(Surroundings {
        conductivity: of.number("conductivity_w_per_mk", medium.conductivity_w_per_mk, &CONDUCTIVITY)?,
        density: of.number("density_kg_per_m3", medium.density_kg_per_m3, &DENSITY)?,
        specific_heat: of.number("specific_heat_j_per_kgk", medium.specific_heat_j_per_kgk, &SPECIFIC_HEAT)?,
        margin: from_mm(at.number("margin_mm", file.margin_mm, &LENGTH_MM)?),
    })
}

pub(crate) fn sensor(at: &Group, file: &SensorFile) -> Result<Sensor, InputError> {
    Ok(Sensor {
        radius: from_mm(at.number("radius_mm", file.radius_mm, &EXTRA_LENGTH_MM)?),
        y: from_mm(at.number("y_mm", file.y_mm, &POSITION_MM)?),
        lag: at.number("lag_s", file.lag_s, &LAG_S)?,
    })
}

pub(crate) fn drifts(at: &Group, file: &DriftsFile) -> Result<Drifts, InputError> {
    Ok(Drifts {
        reference: at.number("reference_c", file.reference_c, &TEMPERATURE_C)?,
        thermo_optic_curvature: at.number(
            "thermo_optic_curvature_per_k2",
            file.thermo_optic_curvature_per_k2,
            &CURVATURE_PER_K2,
        )?,
        read_out: at.number("read_out_deg_per_h_per_k", file.read_out_deg_per_h_per_k, &DRIFT_DEG_PER_H_PER_K)?
            / DEG_PER_H_PER_RAD_PER_S,
    })
}

pub(crate) fn optics(at: &Group, file: &OpticsFile) -> Result<Optics, InputError> {
    Ok(Optics {
        refractive_index: at.number("refractive_index", file.refractive_index, &INDEX)?,
        thermo_optic: at.number("thermo_optic_per_k", file.thermo_optic_per_k, &EXPANSION_PER_K)?,
        thermal_expansion: at.number("thermal_expansion_per_k", file.thermal_expansion_per_k, &EXPANSION_PER_K)?,
        p11: at.number("p11", file.p11, &PHOTOELASTIC)?,
        p12: at.number("p12", file.p12, &PHOTOELASTIC)?,
        sagnac_diameter: from_mm(at.number("sagnac_diameter_mm", file.sagnac_diameter_mm, &LENGTH_MM)?),
        strain: match file.strain {
            StrainFile::Total => StrainConvention::Total,
            StrainFile::Mechanical => StrainConvention::Mechanical,
        },
    })
}
