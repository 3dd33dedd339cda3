//! A controller of Slurm and two nodes.

use std::fs;
use std::net::TcpListener;
use std::path::Path;
use std::process::{Command, Stdio};

use proof::Failure;
use proof::files::failed;
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};

use super::place::{FILES, Place, SHARES, Trial};
use super::processes::{Running, done, until, with_variables};

const TABLE: &str = "slurm.parquet";
/// Programs of a cluster of its own.
const PROGRAMS: [&str; 4] = ["munged", "slurmctld", "slurmd", "sbatch"];
/// Bytes of munge's key.
const KEY: usize = 128;

/// Sweeps the plan with one of two nodes killed.
pub(super) fn sweep(place: &Place) -> Result<Trial, Failure> {
    let there = |program: &&str| Command::new(program).arg("--version").output().is_ok();
    if let Some(missing) = PROGRAMS.iter().find(|program| !there(program)) {
        return Err(Failure(format!(
            "there is no {missing}; install slurmctld, slurmd, slurm-client and munge, or give --no-slurm"
        )));
    }
    let configuration = place.path("slurm.conf");
    let socket = place.path("munge.socket");
    let key = place.path("munge.key");
    fs::write(&configuration, configured(place, &socket)?).map_err(failed(&configuration))?;
    fs::write(&key, secret()).map_err(failed(&key))?;
    done(Command::new("chmod").arg("600").arg(&key))?;
    let start = |command: &mut Command| {
        Running::start(command.env("SLURM_CONF", &configuration).stdout(Stdio::null()).stderr(Stdio::null()))
    };
    let option = |name: &str, path: &Path| format!("--{name}={}", path.display());
    let files = [option("key-file", &key), option("socket", &socket)];
    let more = ["pid", "log", "seed"].map(|name| option(&format!("{name}-file"), &place.path(&format!("munge.{name}"))));
    let _munge = start(place.command("munged").args(["--foreground", "--force"]).args(files).args(more))?;
    until("munge", || Ok(socket.exists()))?;
    let _controller = start(place.command("slurmctld").args(["-D", "-c"]))?;
    let node = |name: &str| start(place.command("slurmd").args(["-D", "-N", name]));
    let (_first, second) = (node("first")?, node("second")?);
    let asked = |program: &str, arguments: &[&str]| {
        let output = place.command(program).args(arguments).env("SLURM_CONF", &configuration).output()?;
        Ok::<_, Failure>(String::from_utf8_lossy(&output.stdout).into_owned())
    };
    until("both nodes", || Ok(asked("sinfo", &["--noheader", "--Node", "--states=idle", "--format=%N"])?.lines().count() == 2))?;
    let array = format!("--array=1-{SHARES}");
    let plan = place.plan();
    let script = place.script("share.sh");
    let mut submit = place.command("sbatch");
    submit
        .args(["--quiet", "--parsable", "--output=/dev/null", &array])
        .arg(&script)
        .arg(&plan)
        .args([TABLE, &SHARES.to_string()]);
    done(submit.env("SLURM_CONF", &configuration).stdout(Stdio::null()))?;
    let submitted = format!("SLURM_SUBMIT_DIR={}", place.folder().display());
    // a node's tasks are no processes below its daemon
    let there = place.kill_half_way(TABLE, second, |_| with_variables(&["SLURMD_NODENAME=second".into(), submitted.clone()]))?;
    until("the array", || Ok(asked("squeue", &["--noheader"])?.trim().is_empty()))?;
    let version = asked("sbatch", &["--version"])?;
    place.merge(TABLE)?;
    let course = format!("a node killed at its task when {there} of {FILES} files of rows were there");
    Ok(Trial { scheduler: version.trim().replace("slurm-wlm", "Slurm"), course, table: TABLE })
}

/// A cluster of two nodes of one core each, which are this machine.
fn configured(place: &Place, socket: &Path) -> Result<String, Failure> {
    let [controller, first, second] = ports()?;
    let said = |program: &str, argument: &str| {
        let output = Command::new(program).arg(argument).output()?;
        Ok::<_, Failure>(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let (host, user, folder) = (said("hostname", "-s")?, said("id", "-un")?, place.path("").display().to_string());
    for name in ["state", "spool-first", "spool-second"] {
        fs::create_dir_all(place.path(name))?;
    }
    Ok(format!(
        "ClusterName=loopback\nSlurmctldHost={host}(127.0.0.1)\nSlurmctldPort={controller}\nSlurmUser={user}\nSlurmdUser={user}\n\
         AuthType=auth/munge\nAuthInfo=socket={}\nStateSaveLocation={folder}state\nSlurmdSpoolDir={folder}spool-%n\n\
         SlurmctldPidFile={folder}slurmctld.pid\nSlurmdPidFile={folder}slurmd-%n.pid\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n\
         JobAcctGatherType=jobacct_gather/none\nSelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\nSlurmdTimeout=10\nMpiDefault=none\n\
         NodeName=first NodeHostname={host} NodeAddr=127.0.0.1 Port={first} CPUs=1\n\
         NodeName=second NodeHostname={host} NodeAddr=127.0.0.1 Port={second} CPUs=1\n\
         PartitionName=all Nodes=first,second Default=YES State=UP\n",
        socket.display()
    ))
}

/// Ports that nobody has.
fn ports() -> Result<[u16; 3], Failure> {
    let bound = [0; 3].map(|_| TcpListener::bind("127.0.0.1:0"));
    let mut ports = [0; 3];
    for (port, bound) in ports.iter_mut().zip(bound) {
        *port = bound?.local_addr()?.port();
    }
    Ok(ports)
}

fn secret() -> [u8; KEY] {
    let mut key = [0; KEY];
    // the cluster ends with the trial, and is heard on this machine alone
    SmallRng::seed_from_u64(u64::from(std::process::id())).fill(&mut key[..]);
    key
}
