//! `cargo xtask bench coil`: the coil job of `benches/peers`, ours and the peers found, interleaved, times beside errors.

use super::publish::{Progress, publish};
use proof::Failure;
use proof::coil_job::{self as job, JobResult, STORED, Setting};
use proof::peers::{self, Program};
use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::Path;

/// Our settings by name; the first is what every ratio is against.
const OURS: [(&str, Setting); 3] = [
    ("fogcoil, 200 steps of 300 s", Setting { orders: [4, 9], layers: [1, 0, 0], ratio: 0.1, steps: 1 }),
    ("fogcoil, 2000 steps of 30 s", Setting { orders: [4, 9], layers: [1, 0, 0], ratio: 0.1, steps: 10 }),
    ("fogcoil, fine, 200 steps", Setting { orders: [5, 7], layers: [2, 1, 1], ratio: 0.12, steps: 1 }),
];
/// Reference of the errors, and the coarser run whose distance bounds its own error.
const REFERENCE: Setting = Setting { orders: [8, 8], layers: [3, 2, 2], ratio: 0.15, steps: 4 };
const SECOND: Setting = Setting { orders: [6, 6], layers: [2, 1, 1], ratio: 0.15, steps: 2 };

/// Meshes for the peers: name, arguments of `mesh_coil.py` before and after the file.
const MESHES: [(&str, &str, &[&str]); 2] = [("h 0.3 mm", "0.3", &[]), ("graded", "0.2", &["1", "10"])];

/// A peer: name, needed module, script, arguments after the mesh, meshes it is run on.
struct Peer {
    name: &'static str,
    module: &'static str,
    script: &'static str,
    arguments: &'static [&'static str],
    meshes: &'static [usize],
}

const PYTHON: [Peer; 3] = [
    Peer {
        name: "scikit-fem, CHOLMOD, P2",
        module: "skfem, sksparse.cholmod",
        script: "coil_skfem.py",
        arguments: &["cholmod"],
        meshes: &[0, 1],
    },
    Peer { name: "NGSolve, P2", module: "ngsolve", script: "coil_ngsolve.py", arguments: &["sparsecholesky", "2"], meshes: &[1] },
    Peer { name: "NGSolve, P4", module: "ngsolve", script: "coil_ngsolve.py", arguments: &["sparsecholesky", "4"], meshes: &[1] },
];

/// Largest errors over all stored instants: mean temperatures \[K\], mean strains relative to the largest of each.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Errors {
    temperature: f64,
    strain: f64,
}

fn errors(course: &[[f64; 5]], reference: &[[f64; 5]]) -> Errors {
    let off = |k: usize| course.iter().zip(reference).fold(0.0, |m: f64, (a, b)| m.max((a[k] - b[k]).abs()));
    let size = |k: usize| reference.iter().fold(0.0, |m: f64, b| m.max(b[k].abs()));
    Errors { temperature: off(0).max(off(1)), strain: (2..5).fold(0.0, |m, k| m.max(off(k) / size(k))) }
}

/// Does the job under one of our settings and prints the result as a peer does.
pub(crate) fn child(name: &str) -> Result<(), Failure> {
    let setting = OURS.iter().find(|(own, _)| *own == name).ok_or_else(|| Failure(format!("no setting is called {name:?}")))?;
    let JobResult { unknowns, phases, course } = job::run(&setting.1)?;
    let phases: serde_json::Map<_, _> = phases.into_iter().map(|(name, s)| (name.to_string(), s.into())).collect();
    let mut out = serde_json::Map::new();
    for n in [STORED / 2, STORED] {
        job::OUTPUTS.iter().zip(course[n - 1]).for_each(|(key, value)| drop(out.insert(format!("{key}{n}"), value.into())));
    }
    let result = serde_json::json!({ "peer": name, "job": "coil", "dof": unknowns[0], "dof2": unknowns[1], "phases": phases,
        "out": out, "course": course });
    println!("RESULT {result}");
    Ok(())
}

fn ours() -> Result<Vec<Program>, Failure> {
    let path = std::env::current_exe()?;
    Ok(OURS.iter().map(|(name, _)| Program::new(*name, &path, ["bench", "coil-job", name])).collect())
}

/// Every peer that is found, with its meshes made in `folder`.
fn found(python: &Path, folder: &Path, progress: &Progress) -> Result<Vec<Program>, Failure> {
    if !peers::has(python, "gmsh, numpy") {
        progress.say("peers skipped: this Python lacks gmsh or numpy (benches/peers/README.md)");
        return Ok(Vec::new());
    }
    let mesh = |k: usize| folder.join(format!("coil{k}"));
    for (k, (name, size, grading)) in MESHES.iter().enumerate() {
        progress.say(&format!("gmsh: mesh {name}"));
        let mut arguments: Vec<OsString> = vec!["mesh_coil.py".into(), size.into(), mesh(k).into()];
        arguments.extend(grading.iter().map(OsString::from));
        peers::run(python, &arguments)?;
    }
    let mut programs = Vec::new();
    for peer in &PYTHON {
        if !peers::has(python, peer.module) {
            progress.say(&format!("{} skipped: this Python lacks {}", peer.name, peer.module));
            continue;
        }
        for &k in peer.meshes {
            let mut arguments: Vec<OsString> = vec![peer.script.into(), mesh(k).with_extension("npz").into()];
            arguments.extend(peer.arguments.iter().map(OsString::from));
            let name = format!("{}, {}", peer.name, MESHES[k].0);
            programs.push(Program::new(name, python, arguments));
        }
    }
    let graded = MESHES.len() - 1;
    let mut arguments: Vec<OsString> = ["-nw", "-v", "0", "coil.edp", "-solver", "CHOLMOD", "-mesh"].map(OsString::from).into();
    arguments.push(mesh(graded).with_extension("msh").into());
    programs.push(Program::new(format!("FreeFem, CHOLMOD, P2, {}", MESHES[graded].0), "FreeFem++", arguments));
    Ok(programs)
}

/// A peer that fails is left out with a message; one of our own must not.
pub(crate) fn run(python: Option<&Path>, repetitions: u64) -> Result<(), Failure> {
    let progress = Progress::new();
    progress.say("reference: orders 8 and 6 on a fine mesh (half a minute)");
    let reference = job::run(&REFERENCE)?.course;
    let uncertainty = errors(&job::run(&SECOND)?.course, &reference);
    let folder = tempfile::tempdir()?;
    let mut programs = ours()?;
    match python {
        Some(python) => programs.extend(found(python, folder.path(), &progress)?),
        None => progress.say("peers skipped: give --peers-python PATH or set FOGCOIL_PEERS_PYTHON"),
    }
    for repetition in 0..repetitions {
        progress.say(&format!("run {} of {}", repetition + 1, repetitions));
        peers::run_each(&mut programs, OURS.len(), |said| progress.say(said))?;
    }
    publish("coil", &section(&programs, &reference, uncertainty, repetitions))
}

fn section(programs: &[Program], reference: &[[f64; 5]], uncertainty: Errors, repetitions: u64) -> String {
    let mut out = String::from(
        "| program | unknowns, heat + strain | wall s | CPU s | compute s | error of temperatures, K | error of strains | CPU ÷ ours | compute ÷ ours |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    let first = &programs[0];
    for program in programs {
        let (name, printed) = (&program.name, program.printed());
        let Errors { temperature, strain } = errors(&printed.course, reference);
        let [wall, process, compute] = [program.median(|r| r.wall), program.process(), program.compute()];
        let [processes, computes] = [process / first.process(), compute / first.compute()];
        let _ = writeln!(
            out,
            "| {name} | {} + {} | {wall:.2} | {process:.2} | {compute:.3} | {temperature:.1e} | {strain:.1e} | {processes:.1} | {computes:.1} |",
            printed.dof, printed.dof2
        );
    }
    let _ = writeln!(
        out,
        "\nMedians of {repetitions} interleaved runs. The reference's own error, by distance to a coarser one: {:.1e} K and {:.1e}.",
        uncertainty.temperature, uncertainty.strain
    );
    let own = errors(&first.printed().course, reference);
    let fastest = |measure: &'static str, of: fn(&Program) -> f64| {
        let peer = programs[OURS.len()..].iter().min_by(|a, b| of(a).total_cmp(&of(b)))?;
        Some((measure, peer, of(peer) / of(first)))
    };
    let pair = [fastest("compute", Program::compute), fastest("CPU of the process", Program::process)];
    for (measure, peer, ratio) in pair.into_iter().flatten() {
        let Errors { temperature, strain } = errors(&peer.printed().course, reference);
        let smaller = own.temperature <= temperature && own.strain <= strain;
        let words = if smaller { "errors no larger" } else { "errors that are NOT both smaller" };
        let _ = writeln!(
            out,
            "\nFastest peer by {measure}: {}. \"{}\" takes 1/{ratio:.1} of it with {words} ({:.2e} K against {temperature:.2e} K, {:.2e} against {strain:.2e}).",
            peer.name, first.name, own.temperature, own.strain
        );
    }
    if let (Some((_, peer, ratio)), Some(equal)) =
        (pair[0], programs[..OURS.len()].iter().find(|p| p.name.contains("2000 steps")))
    {
        let at_equal_steps = ratio * first.compute() / equal.compute();
        let _ = writeln!(
            out,
            "\nAt equal steps, \"{}\" takes 1/{at_equal_steps:.1} of the compute time of {}: the gain above is mostly longer steps of second order.",
            equal.name, peer.name
        );
    }
    out
}
