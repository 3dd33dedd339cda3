//! Groups of keys: the parts of a design that are bought, made or chosen together.

/// A part of a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// Constants of the winding that come from the glass: along the fibre, and the row M.
    Fibre,
    /// Constants that come from coatings and adhesive: across the fibre, density and heat capacity.
    Adhesive,
    /// The spool.
    Spool,
    /// Places of the turns, tails and the potted body's dimensions.
    Winding,
    /// The fibre's optics.
    Optics,
    /// Medium, heat paths, thermometer, and all else.
    Surroundings,
}

/// Keys of the effective constants that the glass decides.
const OF_GLASS: [&str; 4] = ["e_z_gpa", "alpha_z_per_k", "nu_zr", "k_z_w_per_mk"];

impl Group {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Fibre, Self::Adhesive, Self::Spool, Self::Winding, Self::Optics, Self::Surroundings];

    /// The group of a key.
    pub fn of(key: &str) -> Self {
        let last = key.rsplit('.').next().unwrap_or(key);
        let begins = |with: &str| key == with || key.strip_prefix(with).is_some_and(|rest| rest.starts_with(['.', '[']));
        if begins("coil.material") && OF_GLASS.contains(&last) || begins("dehomogenization") {
            Self::Fibre
        } else if begins("coil.material") || begins("coil.density_kg_per_m3") || begins("coil.specific_heat_j_per_kgk") {
            Self::Adhesive
        } else if begins("spool") {
            Self::Spool
        } else if begins("winding") || begins("coil") {
            Self::Winding
        } else if begins("optics") || begins("drifts") {
            Self::Optics
        } else {
            Self::Surroundings
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fibre => "fibre",
            Self::Adhesive => "adhesive",
            Self::Spool => "spool",
            Self::Winding => "winding",
            Self::Optics => "optics",
            Self::Surroundings => "surroundings",
        }
    }
}
