//! Runs of the program whose outputs are known.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use proof::Failure;
use proof::files::{failed, names, root};
use tempfile::TempDir;

/// A command with what it reads and writes.
pub(super) struct Work {
    pub(super) name: &'static str,
    /// Files of the repository, each by the name that it has in the folder of a run; of a recording, its first rows.
    inputs: &'static [(&'static str, &'static str)],
    arguments: &'static str,
    pub(super) outputs: &'static [&'static str],
    /// Whether it refuses to replace an output that is there.
    pub(super) keeps: bool,
}

/// Rows of a recording that are enough to answer, and quick.
const ROWS: usize = 800;

/// Commands that write several files or keep models.
pub(super) const WORKS: [Work; 6] = [
    Work {
        name: "simulate",
        inputs: &[("fixtures/ordinary/B/drawing.ron", "coil.ron"), ("fixtures/profiles/paper.csv", "p.csv")],
        arguments: "simulate coil.ron --profile p.csv --out b.csv --report r.html --quiet",
        outputs: &["b.csv", "r.html"],
        keeps: false,
    },
    Work {
        name: "diagnose",
        inputs: &[
            ("fixtures/ordinary/B/drawing.ron", "coil.ron"),
            ("fixtures/ordinary/B/open/U4907/run1.csv", "a.csv"),
            ("fixtures/ordinary/B/open/U4907/run2.csv", "b.csv"),
        ],
        arguments: "diagnose coil.ron --fit a.csv --holdout b.csv --json d.json --prediction p.csv --model-out m.ron --report r.html --quiet",
        outputs: &["d.json", "p.csv", "m.ron", "r.html"],
        keeps: false,
    },
    Work {
        name: "calibrate",
        inputs: &[
            ("fixtures/ordinary/B/drawing.ron", "coil.ron"),
            ("fixtures/ordinary/B/open/U4907/run1.csv", "a.csv"),
            ("fixtures/ordinary/B/open/U7986/run1.csv", "b.csv"),
        ],
        arguments: "calibrate coil.ron --unit a.csv --unit b.csv --out lot.ron --quiet",
        outputs: &["lot.ron"],
        keeps: false,
    },
    Work {
        name: "homogenize",
        inputs: &[("fixtures/cell-reference.ron", "cell.ron")],
        arguments: "homogenize cell.ron --load dt=10 --vtu c.vtu --svg c.svg",
        outputs: &["c.vtu", "c.svg"],
        keeps: false,
    },
    Work {
        name: "wind",
        inputs: &[("fixtures/coil-reference.ron", "coil.ron")],
        arguments: "wind coil.ron --csv w.csv --svg w.svg",
        outputs: &["w.csv", "w.svg"],
        keeps: false,
    },
    Work {
        name: "check",
        inputs: &[("fixtures/ordinary/B/open/U4907/run1.csv", "a.csv")],
        arguments: "check a.csv --write-map --svg a.svg",
        outputs: &["a.map.ron", "a.svg"],
        keeps: true,
    },
];

/// State of a run's outputs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Left {
    /// As a run that nothing disturbs writes them.
    pub(super) whole: usize,
    pub(super) absent: usize,
    /// Neither.
    pub(super) wrong: usize,
    /// Files that are neither inputs nor outputs.
    pub(super) strays: usize,
}

impl std::ops::AddAssign for Left {
    fn add_assign(&mut self, other: Self) {
        self.whole += other.whole;
        self.absent += other.absent;
        self.wrong += other.wrong;
        self.strays += other.strays;
    }
}

/// Outputs by their names.
pub(super) type Outputs = BTreeMap<&'static str, Vec<u8>>;

/// A folder in which a work is run.
pub(super) struct Place {
    pub(super) folder: TempDir,
}

impl Work {
    /// A fresh folder with the inputs.
    pub(super) fn place(&self) -> Result<Place, Failure> {
        let folder = TempDir::new()?;
        self.furnish(folder.path())?;
        Ok(Place { folder })
    }

    /// Puts the inputs into a folder.
    pub(super) fn furnish(&self, folder: &Path) -> Result<(), Failure> {
        for (file, name) in self.inputs {
            let source = root().join(file);
            let text = fs::read_to_string(&source).map_err(failed(&source))?;
            let rows = if name.ends_with(".csv") { ROWS } else { usize::MAX };
            let text: String = text.split_inclusive('\n').take(rows).collect();
            let path = folder.join(name);
            fs::write(&path, text).map_err(failed(&path))?;
        }
        Ok(())
    }

    /// Starts it in a folder.
    pub(super) fn start(&self, program: &Path, folder: &Path, cache: &Path) -> Result<Child, Failure> {
        Ok(self.command(program, folder, cache).spawn()?)
    }

    /// The run as it would be started.
    pub(super) fn command(&self, program: &Path, folder: &Path, cache: &Path) -> Command {
        let mut command = Command::new(program);
        command.args(self.arguments.split(' ')).current_dir(folder).env("FOGCOIL_CACHE", cache);
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
        command
    }

    /// The outputs of an undisturbed run, and how long it takes.
    pub(super) fn undisturbed(&self, program: &Path, cache: &Path) -> Result<(Outputs, Duration), Failure> {
        let place = self.place()?;
        let start = Instant::now();
        let run = self.command(program, place.folder.path(), cache).output()?;
        let duration = start.elapsed();
        if !run.status.success() {
            return Err(Failure(format!("{}: {}", self.name, said(&run))));
        }
        Ok((self.read(place.folder.path())?, duration))
    }

    /// The outputs in a folder.
    pub(super) fn read(&self, folder: &Path) -> Result<Outputs, Failure> {
        let read = |name: &&'static str| -> Result<_, Failure> {
            let path = folder.join(name);
            Ok((*name, fs::read(&path).map_err(failed(&path))?))
        };
        self.outputs.iter().map(read).collect()
    }

    /// Its arguments, as a shell takes them.
    pub(super) fn words(&self) -> &'static str {
        self.arguments
    }

    /// Bytes of the files in a folder.
    pub(super) fn bytes(&self, folder: &Path) -> Result<usize, Failure> {
        let size = |name: &String| fs::metadata(folder.join(name)).map(|about| about.len() as usize);
        Ok(names(folder)?.iter().map(size).sum::<Result<usize, _>>()?)
    }

    /// Files left in a folder, beside the outputs that may be right.
    pub(super) fn left(&self, folder: &Path, right: &[&Outputs]) -> Result<Left, Failure> {
        let mut left = Left::default();
        let inputs: Vec<&str> = self.inputs.iter().map(|(_, name)| *name).collect();
        for name in names(folder)? {
            if !inputs.contains(&name.as_str()) && !self.outputs.contains(&name.as_str()) {
                left.strays += 1;
            }
        }
        for name in self.outputs {
            match fs::read(folder.join(name)) {
                Err(_) => left.absent += 1,
                Ok(bytes) if right.iter().any(|outputs| outputs.get(name) == Some(&bytes)) => left.whole += 1,
                Ok(_) => left.wrong += 1,
            }
        }
        Ok(left)
    }

    /// The file of the folder that all its answer hangs on.
    pub(super) fn input(&self, folder: &Path) -> PathBuf {
        folder.join(self.inputs[0].1)
    }
}

/// Exit status and last words of a run.
pub(super) fn said(run: &Output) -> String {
    format!("{}, {}", run.status, String::from_utf8_lossy(&run.stderr).trim())
}
