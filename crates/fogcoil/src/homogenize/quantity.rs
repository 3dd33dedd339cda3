//! Fields that a picture can show.

use homogenization::fields::{Component, Convention, State};

use crate::units::{to_mpa, to_ppm};

/// A scalar at each point of the cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// A component of the strain.
    Strain(Component, Convention),
    /// A component of the stress, by its place in Voigt order.
    Stress(usize),
    /// Von Mises' equivalent stress.
    VonMises,
}

impl Quantity {
    fn all() -> Vec<Self> {
        let strains = |convention| Component::ALL.map(|component| Self::Strain(component, convention));
        let mut all = strains(Convention::Total).to_vec();
        all.extend(strains(Convention::Mechanical));
        all.extend((0..6).map(Self::Stress));
        all.push(Self::VonMises);
        all
    }

    /// Name as written: `xx` (total strain), `mechanical_xx`, `stress_xx`, `von_mises`.
    pub fn name(self) -> String {
        match self {
            Self::Strain(component, Convention::Total) => component.name().into(),
            Self::Strain(component, Convention::Mechanical) => format!("mechanical_{}", component.name()),
            Self::Stress(row) => format!("stress_{}", Component::ALL[row].name()),
            Self::VonMises => "von_mises".into(),
        }
    }

    /// Its value in the unit of its label; not a number where it has no meaning (radial and hoop in the adhesive).
    pub(crate) fn of(self, state: &State) -> f64 {
        match self {
            Self::Strain(component, convention) => component.of(state.strain(convention), state.axis).map_or(f64::NAN, to_ppm),
            Self::Stress(row) => to_mpa(state.stress[row]),
            Self::VonMises => to_mpa(state.von_mises()),
        }
    }

    /// Its meaning, with its unit.
    pub fn label(self) -> String {
        match self {
            Self::Strain(component, Convention::Total) => format!("total strain {} [10⁻⁶]", spaced(component)),
            Self::Strain(component, Convention::Mechanical) => format!("mechanical strain {} [10⁻⁶]", spaced(component)),
            Self::Stress(row) => format!("stress {} [MPa]", spaced(Component::ALL[row])),
            Self::VonMises => "equivalent stress (von Mises) [MPa]".into(),
        }
    }
}

fn spaced(component: Component) -> String {
    component.name().replace('_', " ")
}

/// The field of that name.
///
/// # Errors
/// The names there are, in words.
pub fn parse_quantity(text: &str) -> Result<Quantity, String> {
    let all = Quantity::all();
    all.iter().find(|q| q.name() == text).copied().ok_or_else(|| {
        let names: Vec<String> = all.iter().map(|q| q.name()).collect();
        format!("`{text}` is not a field; choose {}", names.join(", "))
    })
}
