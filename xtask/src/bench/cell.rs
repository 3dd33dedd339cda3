//! `cargo xtask bench cell`: from the reference cell to its constants, ours and the peers', error against time.

use super::publish::{Progress, publish};
use homogenization::{Constants, Discretization, FibreCell, Homogenized, TOLERANCE, effective, homogenize_to, multipoles};
use proof::Failure;
use proof::files::root;
use proof::peers::{self, Program, Stopwatch};
use proof::statistics::middle as median;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Relative error of the converged constants, by their own estimate.
const CONVERGED: f64 = 5e-11;
/// Times that a process of ours does its work again: the system's clock of a thread is too coarse for once.
const REPEATED: usize = 40;
/// Processes of ours that one measurement of the whole program takes: the system counts hundredths of a second.
const PROCESSES: usize = 40;

/// Names of the constants as the peers print them.
const NAMES: [&str; 13] =
    ["E_z", "E_r", "G_zr", "G_xy", "nu_zr", "nu_r", "alpha_z", "alpha_r", "k_z", "k_r", "M_rx", "M_rz", "M_rT"];

/// The constant that the peers call `name`.
fn ours(constants: &Constants, name: &str) -> f64 {
    let own = if name == "G_xy" { "g_r".to_owned() } else { name.to_lowercase() };
    constants.named().iter().find(|(name, _)| *name == own).map_or(f64::NAN, |(_, value)| *value)
}

/// Our ways: name, and what it computes.
type Way = fn(&FibreCell) -> Result<(Constants, usize), homogenization::Error>;
const OURS: [(&str, Way); 5] = [
    ("fogcoil, to 1e-6 with its estimate", |cell| estimated(homogenize_to(cell, 1e-6)?)),
    ("fogcoil, to 1e-4 with its estimate", |cell| estimated(homogenize_to(cell, 1e-4)?)),
    ("fogcoil, to 1e-9 with its estimate", |cell| estimated(homogenize_to(cell, 1e-9)?)),
    ("fogcoil, multipoles up to order 33, no estimate", |cell| alone(multipoles(cell, 33)?)),
    ("fogcoil, finite elements of order 6, quarter, no estimate", |cell| {
        alone(effective(cell, &Discretization::standard(cell))?)
    }),
];

fn estimated(result: Homogenized) -> Result<(Constants, usize), homogenization::Error> {
    Ok((result.constants, result.unknowns))
}

fn alone(effective: homogenization::Effective) -> Result<(Constants, usize), homogenization::Error> {
    let singular = || homogenization::Error::Multipoles { order: 0, detail: "the effective stiffness is singular".into() };
    Ok((effective.constants().ok_or_else(singular)?, effective.unknowns))
}

/// A peer's setting: what it is, module, arguments.
struct Peer {
    name: &'static str,
    kind: Kind,
    module: &'static str,
    arguments: &'static [&'static str],
}

/// Who would run it so.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Expert,
    Typical,
}

const PEERS: [Peer; 7] = [
    ngsolve("NGSolve, quarter, curved blocks, condensed, order 5, 1 per 30°", Kind::Expert, &["5", "1", "quarter"]),
    ngsolve("NGSolve, quarter, curved blocks, condensed, order 5, 2 per 30°", Kind::Expert, &["5", "2", "quarter"]),
    ngsolve("NGSolve, whole cell, curved blocks, order 5, 2 per 30°", Kind::Typical, &["5", "2", "whole"]),
    ngsolve("NGSolve, whole cell, free triangles, order 5", Kind::Typical, &["5", "30", "whole", "free"]),
    ngsolve("NGSolve, whole cell, free triangles, order 6", Kind::Typical, &["6", "30", "whole", "free"]),
    skfem("scikit-fem, quarter, P2 curved, 16 per 30°", &["16", "curved", "superlu"]),
    skfem("scikit-fem, quarter, P2 curved, 26 per 30°", &["26", "curved", "superlu"]),
];

const fn ngsolve(name: &'static str, kind: Kind, arguments: &'static [&'static str]) -> Peer {
    Peer { name, kind, module: "ngsolve", arguments }
}

const fn skfem(name: &'static str, arguments: &'static [&'static str]) -> Peer {
    Peer { name, kind: Kind::Typical, module: "skfem", arguments }
}

/// Who would run a program so; `None` of ours.
fn kind(program: &Program) -> Option<Kind> {
    PEERS.iter().find(|peer| peer.name == program.name).map(|peer| peer.kind)
}

fn error(program: &Program, exact: &Constants) -> f64 {
    let out = &program.printed().out;
    let error = |name: &&str| out.get(*name).map_or(f64::NAN, |v| (v / ours(exact, name) - 1.0).abs());
    NAMES.iter().map(error).fold(0.0, |m, e| if e.is_nan() || m.is_nan() { f64::NAN } else { m.max(e) })
}

fn cell_file() -> PathBuf {
    root().join("fixtures/cell-reference.ron")
}

/// Computes the constants in one of our ways and prints them as a peer does.
pub(crate) fn child(name: &str) -> Result<(), Failure> {
    let (_, way) = OURS.iter().find(|(own, _)| *own == name).ok_or_else(|| Failure(format!("no way is called {name:?}")))?;
    let cell = fogcoil::input::read_cell(&cell_file())?.cell;
    // nothing of the solution has been touched before, as in a peer's process
    let first = Instant::now();
    let (constants, unknowns) = way(&cell)?;
    let cold = first.elapsed().as_secs_f64();
    let mut watch = Stopwatch::start();
    for _ in 0..REPEATED {
        std::hint::black_box(way(std::hint::black_box(&cell))?);
    }
    let warm = watch.lap() / REPEATED as f64;
    let out: serde_json::Map<_, _> = NAMES.iter().map(|name| (name.to_string(), ours(&constants, name).into())).collect();
    println!("RESULT {}", serde_json::json!({ "dof": unknowns, "phases": { "compute": cold }, "warm": warm, "out": out }));
    Ok(())
}

fn programs(python: Option<&Path>, progress: &Progress) -> Result<Vec<Program>, Failure> {
    let own = std::env::current_exe()?;
    let mut programs: Vec<_> = OURS.iter().map(|(name, _)| Program::new(*name, &own, ["bench", "cell-job", name])).collect();
    let Some(python) = python else {
        progress.say("peers skipped: give --peers-python PATH or set FOGCOIL_PEERS_PYTHON");
        return Ok(programs);
    };
    for peer in &PEERS {
        if !peers::has(python, &format!("{}, numpy", peer.module)) {
            progress.say(&format!("{} skipped: this Python lacks {} or numpy (benches/peers/README.md)", peer.name, peer.module));
            continue;
        }
        let script = format!("rve_cell_{}.py", peer.module);
        programs.push(Program::new(peer.name, python, [script.as_str()].iter().chain(peer.arguments)));
    }
    Ok(programs)
}

/// Seconds of CPU (wall, where the system does not tell) and of wall that `fogcoil homogenize CELL.ron --json` takes.
fn whole_program(path: &Path) -> Result<[f64; 2], Failure> {
    let (start, before) = (Instant::now(), peers::children());
    for _ in 0..PROCESSES {
        let mut command = Command::new(path);
        let status = command.arg("homogenize").arg(cell_file()).arg("--json").stdout(Stdio::null()).status();
        let status = status.map_err(|e| Failure(format!("{}: {e}", path.display())))?;
        if !status.success() {
            return Err(Failure(format!("{} homogenize: {status}", path.display())));
        }
    }
    let wall = start.elapsed().as_secs_f64();
    let cpu = peers::children().zip(before).map_or(wall, |(after, before)| after - before);
    Ok([cpu, wall].map(|s| s / PROCESSES as f64))
}

/// A peer that fails is left out with a message; one of our own must not.
pub(crate) fn run(python: Option<&Path>, repetitions: u64) -> Result<(), Failure> {
    let progress = Progress::new();
    let cell = fogcoil::input::read_cell(&cell_file())?.cell;
    let exact = homogenize_to(&cell, CONVERGED)?.constants;
    let fogcoil = crate::tools::program()?;
    let mut programs = programs(python, &progress)?;
    let mut whole = Vec::new();
    for repetition in 0..repetitions {
        progress.say(&format!("run {} of {}", repetition + 1, repetitions));
        whole.push(whole_program(&fogcoil)?);
        peers::run_each(&mut programs, OURS.len(), |said| progress.say(said))?;
    }
    let whole = [0, 1].map(|k| median(whole.iter().map(|w| w[k]).collect()));
    publish("cell", &section(&programs, &exact, whole, repetitions))
}

fn section(programs: &[Program], exact: &Constants, [cpu, wall]: [f64; 2], repetitions: u64) -> String {
    let mut out = String::from(
        "| program | unknowns | largest error | compute, first call, ms | warm, CPU ms | whole process, CPU ms | first call ÷ ours |\n\
         |---|---|---|---|---|---|---|\n",
    );
    let first = programs[0].compute();
    for program in programs {
        // ours are timed inside a process of the benchmark's own; the program itself is below
        let process = kind(program).map_or("–".into(), |_| format!("{:.0}", 1e3 * program.process()));
        let (unknowns, error, compute) = (program.printed().dof, error(program, exact), program.compute());
        let (name, clock) = (&program.name, kind(program).map_or("wall", |_| "CPU"));
        let warm: Vec<f64> = program.runs.iter().filter_map(|run| run.printed.warm).collect();
        let warm = if warm.is_empty() { "–".into() } else { format!("{:.2}", 1e3 * median(warm)) };
        let (compute, ratio) = (1e3 * compute, compute / first);
        let _ = writeln!(out, "| {name} | {unknowns} | {error:.1e} | {compute:.2} ({clock}) | {warm} | {process} | {ratio:.1} |");
    }
    let _ = writeln!(
        out,
        "| `fogcoil homogenize CELL.ron --json`, to 1e-6 with its estimate and bounds | | | | | {:.1} (wall {:.1}) | |",
        1e3 * cpu,
        1e3 * wall
    );
    let _ = writeln!(
        out,
        "\nMedians of {repetitions} interleaved runs on one thread, each in a process of its own; meshing counts for all, imports only for \
         whole processes. First calls are cold: ours by the clock, as the system counts a thread's time too coarsely (never less than its \
         CPU time), the peers' in CPU time. Warm: mean of {REPEATED} further calls of ours in the same process. The error is the largest relative one of {} constants; the converged ones are \
         known to {CONVERGED:.0e}.",
        NAMES.len()
    );
    for (kind, who, goal) in [(Kind::Expert, "expert setting", 5), (Kind::Typical, "typical setting", 40)] {
        let exact_enough = |p: &&Program| self::kind(p) == Some(kind) && error(p, exact) <= TOLERANCE;
        let Some(peer) = programs.iter().filter(exact_enough).min_by(|a, b| a.compute().total_cmp(&b.compute())) else {
            let _ = writeln!(out, "\nNo {who} of a peer that was run reaches 1e-6.");
            continue;
        };
        let (compute, process) = (peer.compute() / first, peer.process() / cpu);
        let _ = writeln!(
            out,
            "\nFastest {who} to 1e-6: {}. Ours, with its estimate, takes 1/{compute:.0} of its compute time, first call \
             against first call (asked: 1/{goal}), and 1/{process:.0} of the CPU time of its whole process.",
            peer.name
        );
    }
    out
}
