//! The heat paths of `COIL.ron`: contact resistance, mounts, heaters, film.

use coil::{Contact, FlangeContact, HeatPaths, Heater, Mount, Side, Spool};

use super::InputError;
use super::group::Group;
use super::mirror::{Mirror, mirrored};
use super::quantity::{Conductance, PowerW, Resistance};
use super::winding_file::SideFile;

mirrored! {
    /// Heat paths besides conduction.
    #[derive(Default)]
    #[serde(default)]
    HeatFile is HeatPaths {
        /// Contact resistance between hub and coil, where they are bonded; 0 unless given.
        hub_resistance_m2k_per_w: Resistance = hub_resistance,
        /// Contact resistances between flanges and the coil's faces; none unless given.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        flange_contacts: Vec<FlangeContactFile> = flange_contacts,
        /// Paths from an end of the spool, a flange or the bare hub, to its mount; none unless given.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        mounts: Vec<MountFile> = mounts,
        /// Heat dissipated in an end of the spool; none unless given.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        heaters: Vec<HeaterFile> = heaters,
        /// Film coefficient of every outer surface to the chamber, in place of the still medium; None unless given.
        film_w_per_m2k: Option<Conductance> = film,
    }

    /// A contact resistance between a bonded flange and the coil's face.
    FlangeContactFile is FlangeContact {
        /// Side of the flange.
        side: SideFile = side,
        /// Resistance times area.
        resistance_m2k_per_w: Resistance = resistance,
    }

    /// A path from the outer face of a flange, or of the hub where there is no flange, to its mount, or to the chamber.
    MountFile is Mount {
        /// End of the spool.
        side: SideFile = side,
        /// Conductance per area.
        conductance_w_per_m2k: Conductance = conductance,
    }

    /// Heat dissipated evenly in a flange, or in the hub where there is no flange, on from the first row of the profile.
    HeaterFile is Heater {
        /// End of the spool.
        side: SideFile = side,
        /// Power.
        power_w: PowerW = power,
    }
}

/// The paths, if the spool has the faces that they start from.
pub(super) fn paths(at: &Group, file: &HeatFile, spool: Option<&Spool>) -> Result<HeatPaths, InputError> {
    let paths: HeatPaths = file.model();
    if paths.hub_resistance > 0.0 && spool.is_none_or(|spool| spool.hub_contact == Contact::Gap) {
        let problem = "no hub is bonded to the coil, so there is no contact to resist";
        return Err(at.fault("hub_resistance_m2k_per_w", problem, "remove the field, or set spool.hub_bonded to true"));
    }
    one_a_side(at, "flange_contacts", paths.flange_contacts.iter().map(|contact| contact.side), spool)?;
    for (i, contact) in paths.flange_contacts.iter().enumerate() {
        let side = contact.side;
        if !spool.iter().flat_map(|spool| &spool.flanges).any(|flange| flange.side == side) {
            let problem = format!("the spool has no flange at the side {side:?}");
            let remedy = "name a side that has one in spool.flanges, or add it there";
            return Err(at.fault(&format!("flange_contacts[{i}].side"), problem, remedy));
        }
        let gap = |f: &coil::Flange| f.side == contact.side && f.contact == Contact::Gap;
        if spool.iter().flat_map(|spool| &spool.flanges).any(gap) {
            let problem = "this flange is not bonded to the coil, so there is no contact to resist";
            let remedy = "remove the entry, or set the flange's bonded to true";
            return Err(at.fault(&format!("flange_contacts[{i}].side"), problem, remedy));
        }
    }
    one_a_side(at, "mounts", paths.mounts.iter().map(|mount| mount.side), spool)?;
    one_a_side(at, "heaters", paths.heaters.iter().map(|heater| heater.side), spool)?;
    Ok(paths)
}

/// Refuses sides of a spool that is not there, and a second of a kind at one.
fn one_a_side(at: &Group, name: &str, sides: impl Iterator<Item = Side>, spool: Option<&Spool>) -> Result<(), InputError> {
    let mut taken = Vec::new();
    for (i, side) in sides.enumerate() {
        let fault = |problem: String, remedy: &str| Err(at.fault(&format!("{name}[{i}].side"), problem, remedy));
        if spool.is_none() {
            return fault(format!("there is no spool that has an end at the side {side:?}"), "remove the entry, or add a spool");
        }
        if taken.contains(&side) {
            return fault(format!("a second one at the side {side:?}"), "give at most one a side, with the values combined");
        }
        taken.push(side);
    }
    Ok(())
}
