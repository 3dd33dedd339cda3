//! The heat paths of a coil file: contact resistance, mounts, heaters, film.

use coil::{Contact, HeatPaths, Heater, Mount, Side, Spool};

use super::InputError;
use super::coil_file::{HeatFile, SideFile};
use super::coil_parts::side;
use super::limits::{CONDUCTANCE, Group, POWER_W, RESISTANCE};

pub(crate) fn paths(at: &Group, file: &HeatFile, spool: Option<&Spool>) -> Result<HeatPaths, InputError> {
    let hub_resistance = at.number("hub_resistance_m2k_per_w", file.hub_resistance_m2k_per_w, &RESISTANCE)?;
    if hub_resistance > 0.0 && spool.is_none_or(|spool| spool.hub_contact == Contact::Gap) {
        let remedy = "remove the field, or set spool.hub_bonded to true";
        return Err(at.fault(
            "hub_resistance_m2k_per_w",
            "no hub is bonded to the coil, so there is no contact to resist",
            remedy,
        ));
    }
    let mut mounts: Vec<Mount> = Vec::new();
    for (i, file) in file.mounts.iter().enumerate() {
        let at = at.group(&format!("mounts[{i}]"));
        let side = flange_side(&at, file.side, spool, mounts.iter().map(|other| other.side))?;
        let conductance = at.number("conductance_w_per_m2k", file.conductance_w_per_m2k, &CONDUCTANCE)?;
        mounts.push(Mount { side, conductance });
    }
    let mut heaters: Vec<Heater> = Vec::new();
    for (i, file) in file.heaters.iter().enumerate() {
        let at = at.group(&format!("heaters[{i}]"));
        let side = flange_side(&at, file.side, spool, heaters.iter().map(|other| other.side))?;
        heaters.push(Heater { side, power: at.number("power_w", file.power_w, &POWER_W)? });
    }
    let film = file.film_w_per_m2k.map(|film| at.number("film_w_per_m2k", film, &CONDUCTANCE)).transpose()?;
    Ok(HeatPaths { hub_resistance, mounts, heaters, film })
}

/// The side, if a flange stands there and none of its kind sits there already.
fn flange_side(
    at: &Group,
    file: SideFile,
    spool: Option<&Spool>,
    mut taken: impl Iterator<Item = Side>,
) -> Result<Side, InputError> {
    let side = side(file);
    if !spool.iter().flat_map(|spool| &spool.flanges).any(|flange| flange.side == side) {
        let problem = format!("the spool has no flange at the side {side:?}");
        return Err(at.fault("side", problem, "name a side that has one in spool.flanges, or add it there"));
    }
    if taken.any(|other| other == side) {
        return Err(at.fault(
            "side",
            format!("a second one at the side {side:?}"),
            "give at most one a side, with the values combined",
        ));
    }
    Ok(side)
}
