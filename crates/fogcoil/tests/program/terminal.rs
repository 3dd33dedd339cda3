//! The terminal's side of the program: files to start from, explanations, completions, manual, quiet, interrupts, closed pipes.

use std::fs;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use crate::common::{CELL, COIL, Folder, change, stderr, stdout};
use fogcoil::glossary::{Remark, mechanisms};
use serde_json::Value;

/// A RON file without comments and without the name.
fn bare(text: &str) -> String {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    let code: String = code
        .filter(|line| !line.trim_start().starts_with("name: \"my-") && !line.trim_start().starts_with("name: \"ref"))
        .collect();
    let code: String = code.replace("/*, lag_s: 0.0 */", "").split_whitespace().collect();
    // the tolerances that a new design writes out are those of a design that gives none
    let code = match code.split_once("tolerances:{") {
        Some((before, after)) => before.to_owned() + after.split_once("},").map_or("", |(_, rest)| rest),
        None => code,
    };
    code.replace(",)", ")").replace(",]", "]")
}

#[test]
fn a_new_design_runs_and_gives_the_reference_and_is_never_overwritten() {
    let folder = Folder::new();
    for (kind, file, reference) in
        [("coil", "c.ron", Some(COIL)), ("cell", "f.ron", Some(CELL)), ("profile", "p.csv", None), ("targets", "t.ron", None)]
    {
        let output = folder.run(&["new", file, "--kind", kind]);
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""), "{kind}");
        let text = fs::read_to_string(folder.path(file)).unwrap();
        assert!(reference.is_none_or(|reference| bare(&text) == bare(reference)), "{kind}: {}", bare(&text));
        let again = folder.run(&["new", kind, file]);
        assert_eq!(again.status.code(), Some(2));
        assert!(
            stderr(&again).contains(&format!("{file}: exists and is left as it is; give another name")),
            "{}",
            stderr(&again)
        );
        assert_eq!(fs::read_to_string(folder.path(file)).unwrap(), text);
    }
    // the kind may stand first
    let limits = folder.run(&["new", "limits", "l.ron"]);
    assert!(limits.status.success() && folder.path("l.ron").exists() && !folder.path("limits").exists());
    let two = folder.run(&["new", "a.ron", "b.ron"]);
    assert!(two.status.code() == Some(2) && stderr(&two).contains("a.ron is no kind of file"), "{}", stderr(&two));
    fogcoil::input::read_targets(&folder.path("t.ron")).unwrap();
    let case = fogcoil::input::read_coil(&folder.path("c.ron")).unwrap();
    assert!(
        case.warnings.is_empty()
            && fogcoil::input::read_profile(&folder.path("p.csv"), &case.design, &[]).unwrap().notes.is_empty()
    );
    let output = folder.run(&["sensitivity", "c.ron", "--json"]);
    let total: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!((total["total"].as_f64().unwrap() + 2.7335).abs() < 5e-5, "{total}");
    let output = folder.run(&["homogenize", "f.ron", "--json"]);
    let cell: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!((cell["e_r"].as_f64().unwrap() / 95.205e6 - 1.0).abs() < 1e-5, "{cell}");
    // what is commented out parses, too: every optional part but the mechanics, of which one is allowed
    let (head, tail) = uncommented(&fs::read_to_string(folder.path("c.ron")).unwrap());
    folder.write("all.ron", head.clone() + &tail);
    let case = fogcoil::input::read_coil(&folder.path("all.ron")).unwrap();
    assert_eq!(case.design.winding.defect.unwrap().turns, -3, "{head}");
    assert!(matches!(case.design.mechanics, coil::Mechanics::Relaxing { .. }), "{:?}", case.design.mechanics);
}

/// A coil's template with what is commented out in force, and what stands behind its last bracket.
fn uncommented(template: &str) -> (String, String) {
    let lines = template.lines().map(|line| {
        let code = line.trim_start().strip_prefix("// ").unwrap_or(line);
        let is_code = [
            "defect:",
            "heat:",
            "drifts:",
            "    hub_",
            "    mounts",
            "    heaters",
            "    film",
            "    reference_c",
            "    thermo_optic_c",
            "    read_out",
            "),",
            "mechanics: Relaxing",
        ];
        if is_code.iter().any(|start| code.starts_with(start)) { code.to_owned() } else { line.to_owned() }
    });
    let text = lines.collect::<Vec<_>>().join("\n");
    let (head, tail) = text.rsplit_once(')').unwrap();
    (head.to_owned(), format!("){tail}"))
}

#[test]
fn every_id_is_explained_and_a_wrong_one_is_answered_with_the_nearest() {
    let folder = Folder::new();
    let list = stdout(&folder.run(&["explain"]));
    let all: Value = serde_json::from_str(&stdout(&folder.run(&["explain", "--json"]))).unwrap();
    assert_eq!(all["mechanisms"].as_array().unwrap().len(), mechanisms().count());
    assert_eq!(all["remarks"].as_array().unwrap().len(), Remark::ALL.len());
    for id in mechanisms().map(|m| m.id).chain(Remark::ALL.iter().map(|r| r.id())) {
        assert!(list.lines().any(|line| line.split_whitespace().next() == Some(id)), "{id}");
    }
    let head = stdout(&folder.run(&["explain", "kelvin"])).lines().next().unwrap().to_owned();
    assert!(head.starts_with("kelvin: A profile's chamber_c never falls"), "{head}");
    let debond = stdout(&folder.run(&["explain", "debond"]));
    for part in ["Equation", "debond_c", "hysteresis_k", "Place in the chain", "Signature", "Rivals", "ultrasound", "Hutchinson"]
    {
        assert!(debond.contains(part), "{part}: {debond}");
    }
    let gap: Value = serde_json::from_str(&stdout(&folder.run(&["explain", "long-tail", "--json"]))).unwrap();
    assert!(["cause", "consequence", "remedy"].iter().all(|key| gap[key].as_str().unwrap().len() > 10), "{gap}");
    let wrong = folder.run(&["explain", "air-pth"]);
    assert_eq!((wrong.status.code(), stdout(&wrong).as_str()), (Some(2), ""));
    assert!(stderr(&wrong).contains("nearest: air-path; "), "{}", stderr(&wrong));
    let missing = folder.run(&["explain", "coil.ron"]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(stderr(&missing).contains("coil.ron: is no file"), "{}", stderr(&missing));
    folder.write("coil.ron", COIL);
    let coil = folder.run(&["explain", "coil.ron"]);
    assert_eq!(coil.status.code(), Some(2));
    assert!(stderr(&coil).contains("add --sensitivity S"), "{}", stderr(&coil));
}

#[test]
fn a_warning_ends_in_its_id_and_quiet_leaves_it() {
    let folder = Folder::new();
    folder.write("c.ron", change(COIL, "(cw: 0.0, ccw: 0.0)", "(cw: 800.0, ccw: 0.0)"));
    let loud = folder.run(&["wind", "c.ron", "--json"]);
    assert!(stderr(&loud).ends_with("is this meant? [long-tail]\n"), "{}", stderr(&loud));
    assert!(stderr(&loud).starts_with("warning: c.ron: "), "{}", stderr(&loud));
    let object: Value = serde_json::from_str(&stdout(&loud)).unwrap();
    assert_eq!((&object["turns"], &object["tails_m"]["cw"]), (&Value::from(3798), &Value::from(800.0)));
    for arguments in [["--quiet", "wind", "c.ron", "--json"], ["wind", "c.ron", "--json", "--quiet"]] {
        let quiet = folder.run(&arguments);
        assert_eq!((quiet.status.code(), stderr(&quiet), stdout(&quiet)), (Some(0), stderr(&loud), stdout(&loud)));
    }
}

#[test]
fn completions_and_manual_name_every_command() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = stdout(&folder.run(&["completions", shell]));
        assert!(
            ["diagnose", "explain", "--model-out"].iter().all(|word| script.contains(word.trim_start_matches('-'))),
            "{shell}"
        );
    }
    let page = stdout(&folder.run(&["man"]));
    assert!(page.contains(".TH fogcoil 1") && page.contains("Exit status: 0 done"), "{page}");
    let written = folder.run(&["man", "--dir", "man"]);
    assert_eq!(written.status.code(), Some(0));
    assert!(stderr(&written).starts_with("note: man/fogcoil.1 and ") && stderr(&written).ends_with(" more files are written\n"));
    let help = stdout(&folder.run(&["--help"]));
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    for command in commands.map(|line| line.split_whitespace().next().unwrap()).filter(|command| *command != "help") {
        let page = fs::read_to_string(folder.path(&format!("man/fogcoil-{command}.1"))).unwrap();
        assert!(page.contains(&format!("fogcoil\\-{command}")), "{page}");
        let synopsis = page.split(".SH").find(|section| section.starts_with(" SYNOPSIS")).unwrap();
        let shown = command != "simulate" || synopsis.contains("\\-\\-out <B.csv>");
        assert!(shown && synopsis.contains(&format!("fogcoil {command}")), "{synopsis}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_and_a_closed_pipe_is_no_failure() {
    let folder = Folder::new();
    folder.write("c.ron", COIL);
    folder.write("p.csv", "time_s,chamber_c\n0,20\n100000,60\n");
    let program = env!("CARGO_BIN_EXE_fogcoil");
    let mut command = Command::new(program);
    command.args(["simulate", "c.ron", "--profile", "p.csv", "--out", "b.csv", "--no-cache"]).current_dir(folder.path("."));
    // signals that whoever runs the tests ignores are ignored by what they start, too
    let ignored = |signal: &str| {
        let script = format!("kill {signal} $$; exit 7");
        Command::new("sh").args(["-c", &script]).status().unwrap().code() == Some(7)
    };
    for (signal, status) in [("-INT", 130), ("-TERM", 143), ("-HUP", 129)].into_iter().filter(|(signal, _)| !ignored(signal)) {
        let running = command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
        thread::sleep(Duration::from_millis(150));
        Command::new("kill").args([signal, &running.id().to_string()]).status().unwrap();
        let output = running.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(status), "{signal}");
        assert!(stderr(&output).ends_with("interrupted; nothing is written\n"), "{}", stderr(&output));
        assert_eq!(folder.names(), ["c.ron", "p.csv"], "{signal}");
    }
    // as under nohup: a hang-up that is ignored stays so
    let script = r#"trap "" HUP; exec "$0" simulate c.ron --profile p.csv --out b.csv --no-cache"#;
    let mut ignoring = Command::new("sh");
    ignoring.args(["-c", script, program]).current_dir(folder.path("."));
    let running = ignoring.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    thread::sleep(Duration::from_millis(150));
    for signal in ["-HUP", "-TERM"] {
        Command::new("kill").args([signal, &running.id().to_string()]).status().unwrap();
        thread::sleep(Duration::from_millis(50));
    }
    assert_eq!(running.wait_with_output().unwrap().status.code(), Some(143));
    let list = Command::new(program).arg("explain").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let mut closed = list.unwrap();
    drop(closed.stdout.take());
    let output = closed.wait_with_output().unwrap();
    assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
}
