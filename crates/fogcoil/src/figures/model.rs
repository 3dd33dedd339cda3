//! The model: coil, spool, medium, chamber wall, thermometer and mesh, to scale (Fig. 2).

use charts::{Area, Arrow, Axis, Drawing, Figure, Fill, Panel};
use coil::{Bonds, COARSE, Contact, Domain, Grid, Layout, Rectangle, Region, Side};

use crate::input::CoilCase;
use crate::units::to_mm;

/// Highest drawing, in font sizes.
const MOST_HIGH: f64 = 32.0;

fn mm(ends: [f64; 2]) -> [f64; 2] {
    ends.map(to_mm)
}

pub(super) fn figure<'a>(case: &CoilCase) -> Figure<'a> {
    // a design that was simulated has a layout
    let panels = Layout::new(&case.design).map_or(Vec::new(), |layout| vec![whole(case, &layout), enlarged(case, &layout)]);
    Figure {
        id: "model",
        title: "The model".into(),
        description: "Half cross-section of coil, hub and flanges in the chamber, and the solids enlarged with the mesh.".into(),
        caption: format!(
            "Half of the cross-section; the axis of symmetry is r = 0, the chamber's wall the heavy line. Mesh: elements of order {}, \
             graded towards the edges of the coil. Counterpart of Osunluk et al., Fig. 2.",
            COARSE.order
        ),
        columns: 2,
        panels,
    }
}

/// The solids of two designs A and B, the one beside the other and each to its own scale.
pub(crate) fn side_by_side<'a>(cases: [&CoilCase; 2]) -> Figure<'a> {
    let of = |(letter, case): (&str, &CoilCase)| {
        let layout = Layout::new(&case.design).ok()?;
        Some(enlarged(case, &layout).headed(format!("{letter}: {}", case.name)))
    };
    Figure {
        id: "coils",
        title: "Both coils".into(),
        description: "Half cross-sections of the solids of A and of B with their meshes, side by side.".into(),
        caption: format!(
            "Coil, hub and flanges, lengths in mm, each to its own scale. Mesh: elements of order {}, graded towards the edges of the coil.",
            COARSE.order
        ),
        columns: 2,
        panels: ["A", "B"].into_iter().zip(cases).filter_map(of).collect(),
    }
}

fn area(rectangle: &Rectangle, name: String) -> Area {
    let fill = match rectangle.region {
        Region::Coil => Fill::Cool,
        Region::Hub | Region::Contact | Region::LeftContact | Region::RightContact => Fill::Sand,
        Region::LeftFlange | Region::RightFlange => Fill::Clay,
        Region::Medium => Fill::Blank,
    };
    Area { fill, name, x: mm(rectangle.y), y: mm(rectangle.r) }
}

/// Parts from the back to the front: where two overlap the layout's earlier one holds.
fn solids(layout: &Layout, name: impl Fn(&Rectangle) -> String) -> Vec<Area> {
    layout.solids.iter().rev().map(|solid| area(solid, name(solid))).collect()
}

fn panel(heading: &str, drawing: Drawing) -> Panel<'static> {
    let [axial, radial] = ["axial position y [mm]", "radius r [mm]"].map(|label| Axis::tight(label, 1e-6));
    Panel::drawing(axial, radial, MOST_HIGH, drawing).headed(heading)
}

fn mesh(layout: &Layout, domain: Domain) -> Vec<[[f64; 2]; 2]> {
    let Ok(grid) = Grid::new(layout, &COARSE, domain, Bonds::Closed) else { return Vec::new() };
    let nodes = grid.mesh().nodes();
    let corners = |element: &Vec<usize>| {
        let (a, b) = (nodes[element[0]], nodes[element[element.len() - 1]]);
        [mm([a[1], b[1]]), mm([a[0], b[0]])]
    };
    grid.mesh().elements().iter().map(corners).collect()
}

fn whole(case: &CoilCase, layout: &Layout) -> Panel<'static> {
    let (design, chamber) = (&case.design, &layout.chamber);
    let film = design.heat.film;
    let around = match film {
        Some(film) => format!("film of {film} W/(m² K) on every outer surface"),
        None => "chamber wall, medium inside".into(),
    };
    let mut areas = vec![area(chamber, String::new())];
    areas.extend(solids(layout, |_| String::new()));
    areas.push(Area {
        fill: if film.is_none() { Fill::Heavy } else { Fill::Dashed },
        name: around,
        x: mm(chamber.y),
        y: mm(chamber.r),
    });
    let middle = to_mm(design.body.height / 2.0);
    let top = layout.solids.iter().map(|s| s.r[1]).fold(0.0, f64::max);
    let mut arrows = vec![Arrow { from: [middle, 0.0], to: [middle, to_mm(layout.bore)], label: round(layout.bore) }];
    if film.is_none() {
        let at = to_mm(chamber.y[0] + 0.25 * (chamber.y[1] - chamber.y[0]));
        arrows.push(Arrow { from: [at, to_mm(top)], to: [at, to_mm(chamber.r[1])], label: round(design.surroundings.margin) });
    }
    let place = [design.sensor.y, design.sensor.radius];
    let domain = if film.is_some() { Domain::SolidsAndGaps } else { Domain::Chamber };
    let drawing = Drawing { areas, mesh: mesh(layout, domain), point: Some((mm(place), "thermometer".into())), arrows };
    panel("In the chamber, lengths in mm", drawing)
}

fn enlarged(case: &CoilCase, layout: &Layout) -> Panel<'static> {
    let design = &case.design;
    let (spool, body) = (design.spool.as_ref(), &design.body);
    let contact = |contact: Contact| if contact == Contact::Bonded { "bonded" } else { "gap 0.2" };
    let name = |solid: &Rectangle| match solid.region {
        Region::Coil => format!("coil, r {:.3} to {:.3}", to_mm(solid.r[0]), to_mm(solid.r[1])),
        Region::Hub => spool.map_or(String::new(), |s| format!("hub, {}", contact(s.hub_contact))),
        Region::LeftFlange | Region::RightFlange => {
            let side = if solid.region == Region::LeftFlange { Side::Left } else { Side::Right };
            let flange = spool.and_then(|s| s.flanges.iter().find(|f| f.side == side));
            flange.map_or(String::new(), |f| {
                let name = if side == Side::Left { "left" } else { "right" };
                format!("{name} flange, {} thick, {} overhang, {}", round(f.thickness), round(f.overhang), contact(f.contact))
            })
        }
        Region::Contact | Region::LeftContact | Region::RightContact | Region::Medium => String::new(),
    };
    let most = |f: fn(&Rectangle) -> f64| layout.solids.iter().map(f).fold(f64::NEG_INFINITY, f64::max);
    let (r, y) = ([-most(|s| -s.r[0]), most(|s| s.r[1])], [-most(|s| -s.y[0]), most(|s| s.y[1])]);
    let reach = 0.04 * (r[1] - r[0]).max(y[1] - y[0]);
    let within =
        Rectangle { region: Region::Medium, r: [(r[0] - reach).max(0.0), r[1] + reach], y: [y[0] - reach, y[1] + reach] };
    let mut areas = vec![area(&within, String::new())];
    areas.extend(solids(layout, name));
    let (inner, outer) = (design.winding.inner_radius, body.outer_radius);
    let at = |share: f64, ends: [f64; 2]| to_mm(ends[0] + share * (ends[1] - ends[0]));
    let (across, up) = ([0.0, body.height], [inner, outer]);
    let mut arrows = vec![
        Arrow { from: [0.0, at(0.75, up)], to: [to_mm(body.height), at(0.75, up)], label: round(body.height) },
        Arrow { from: [at(0.2, across), to_mm(inner)], to: [at(0.2, across), to_mm(outer)], label: round(outer - inner) },
    ];
    if let Some(spool) = spool {
        let hub = inner - spool.hub_contact.gap();
        let label = round(spool.hub_thickness);
        arrows.push(Arrow { from: [at(0.2, across), to_mm(hub)], to: [at(0.2, across), to_mm(layout.bore)], label });
    }
    let place = [design.sensor.y, design.sensor.radius];
    let inside = (within.y[0]..=within.y[1]).contains(&place[0]) && (within.r[0]..=within.r[1]).contains(&place[1]);
    let point = inside.then(|| (mm(place), format!("thermometer, r {}, y {}", round(place[1]), round(place[0]))));
    panel("Solids and mesh, lengths in mm", Drawing { areas, mesh: mesh(layout, Domain::Solids), point, arrows })
}

/// Millimetres to a micrometre, without zeros at the end.
fn round(metres: f64) -> String {
    let text = format!("{:.3}", to_mm(metres));
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
