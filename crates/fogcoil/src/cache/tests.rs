//! Kept models: bit for bit, of this build and user alone, whatever happens to their files.

use super::*;
use crate::input::read_coil;
use coil::{
    Design, Drive, Dynamics, FactorsAt, Fidelity, Heater, Mechanics, MeshFineness, Mount, Opening, Profile, STANDARD, Side,
};
use serde_json::Value;
use std::convert::Infallible;
use std::time::Duration;

const QUICK: Fidelity = Fidelity { resolution: MeshFineness { order: 2, layers: 1, ratio: 0.2 }, modes: 6 };

fn reference() -> Design {
    read_coil(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron").as_ref()).unwrap().design
}

/// A cache in a new folder with one model in it, and the model's file.
fn with_one(model: &[f64]) -> (tempfile::TempDir, Cache, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::in_folder(folder.path().join("made/on/demand"));
    assert_eq!(get(&cache, 1, model), (model.to_vec(), Source::Built));
    let file = fs::read_dir(folder.path().join("made/on/demand")).unwrap().next().unwrap().unwrap().path();
    (folder, cache, file)
}

fn get(cache: &Cache, key: u32, built: &[f64]) -> (Vec<f64>, Source) {
    cache.load_or_build("test", &key, || Ok::<_, Infallible>(built.to_vec())).unwrap()
}

const MODEL: [f64; 4] = [0.1, -0.0, f64::NEG_INFINITY, 5e-324];

#[test]
fn what_was_kept_comes_back_bit_for_bit_and_nothing_else_does() {
    let (_folder, cache, _) = with_one(&MODEL);
    let (found, source) = get(&cache, 1, &[]);
    assert_eq!(source, Source::Cached);
    assert!(found.iter().zip(&MODEL).all(|(a, b)| a.to_bits() == b.to_bits()) && found.len() == 4);
    assert_eq!(get(&cache, 2, &[2.0]), (vec![2.0], Source::Built));
    let other = cache.load_or_build("other", &1u32, || Ok::<_, Infallible>(vec![3.0])).unwrap();
    assert_eq!(other, (vec![3.0], Source::Built));
    assert_eq!(get(&Cache::NONE, 1, &[4.0]), (vec![4.0], Source::Built));
    let failed: Result<(Vec<f64>, Source), &str> = cache.load_or_build("test", &9u32, || Err("no"));
    assert_eq!(failed, Err("no"));
    assert_eq!(get(&cache, 9, &[5.0]).1, Source::Built, "a failure is not kept");
}

#[test]
fn a_spoilt_file_is_built_anew() {
    let (folder, cache, file) = with_one(&MODEL);
    let sound = fs::read(&file).unwrap();
    let rebuilt = |bytes: &[u8]| {
        fs::write(&file, bytes).unwrap();
        assert_eq!(get(&cache, 1, &[7.0]), (vec![7.0], Source::Built), "{} bytes", bytes.len());
        assert_eq!(get(&cache, 1, &[]), (vec![7.0], Source::Cached), "and kept again");
    };
    (0..sound.len()).for_each(|length| rebuilt(&sound[..length]));
    for byte in 0..sound.len() {
        let mut spoilt = sound.clone();
        spoilt[byte] ^= 0x10;
        rebuilt(&spoilt);
    }
    rebuilt(&[&sound[..], b"x"].concat());
    // a length that no memory holds, under a checksum that is right
    let digits = file.file_name().unwrap().to_str().unwrap();
    let name: Name = std::array::from_fn(|i| u8::from_str_radix(&digits[2 * i..2 * i + 2], 16).unwrap());
    let hostile = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01, 0, 0];
    rebuilt(&[&header(&name, &hostile)[..], &hostile].concat());
    // a file of any length takes no more memory than a model may
    File::create(&file).unwrap().set_len(1 << 30).unwrap();
    assert_eq!(get(&cache, 1, &[8.0]), (vec![8.0], Source::Built));
    // a sound file of another model
    assert_eq!(get(&cache, 2, &[2.0]).1, Source::Built);
    let all = || fs::read_dir(folder.path().join("made/on/demand")).unwrap().map(|e| e.unwrap().path());
    let other = all().find(|path| *path != file).unwrap();
    fs::copy(other, &file).unwrap();
    assert_eq!(get(&cache, 1, &[9.0]), (vec![9.0], Source::Built));
    assert_eq!(all().count(), 2, "no temporary file stays");
    fs::remove_file(&file).unwrap();
    fs::create_dir(&file).unwrap();
    assert_eq!(get(&cache, 1, &[6.0]), (vec![6.0], Source::Built), "a folder in its place");
}

#[cfg(unix)]
#[test]
fn a_file_that_others_can_have_written_is_built_anew() {
    use std::os::unix::fs::{PermissionsExt, chown};
    let (_folder, cache, file) = with_one(&MODEL);
    fs::set_permissions(&file, fs::Permissions::from_mode(0o666)).unwrap();
    assert_eq!(get(&cache, 1, &[7.0]), (vec![7.0], Source::Built));
    assert_eq!(get(&cache, 1, &[]), (vec![7.0], Source::Cached), "and kept again");
    // only the administrator can give a file away
    if chown(&file, Some(65534), None).is_ok() {
        assert_eq!(get(&cache, 1, &[8.0]), (vec![8.0], Source::Built));
        assert_eq!(get(&cache, 1, &[]), (vec![8.0], Source::Cached), "and kept again");
    }
}

#[cfg(unix)]
#[test]
fn another_build_of_the_same_length_and_instant_is_another() {
    let folder = tempfile::tempdir().unwrap();
    let code = folder.path().join("code");
    let install = |content: &str| {
        let new = folder.path().join("new");
        fs::write(&new, content).unwrap();
        File::options().write(true).open(&new).unwrap().set_modified(UNIX_EPOCH).unwrap();
        fs::rename(&new, &code).unwrap();
    };
    let cache = Cache::in_folder(folder.path().join("cache")).of_code_in(&code);
    install("one");
    assert_eq!(get(&cache, 1, &[1.0]), (vec![1.0], Source::Built));
    assert_eq!(get(&cache, 1, &[]), (vec![1.0], Source::Cached));
    install("two");
    assert_eq!(get(&cache, 1, &[2.0]), (vec![2.0], Source::Built));
}

#[test]
fn where_nothing_can_be_written_models_are_built() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "not a folder").unwrap();
    for cache in [Cache::in_folder(&file), Cache::in_folder(file.join("below"))] {
        for _ in 0..2 {
            assert_eq!(get(&cache, 1, &MODEL).1, Source::Built);
        }
    }
    assert_eq!(fs::read(&file).unwrap(), b"not a folder");
}

#[test]
fn the_longest_unused_go_first_and_strangers_stay() {
    let (folder, mut cache, first) = with_one(&[0.0; 1000]);
    let stranger = folder.path().join("made/on/demand/notes.txt");
    fs::write(&stranger, [0; 100_000]).unwrap();
    cache.most = 25_000; // three files of 8 kB and their headers
    let touch = |path: &Path, seconds: u64| {
        File::options().write(true).open(path).unwrap().set_modified(UNIX_EPOCH + Duration::from_secs(seconds)).unwrap();
    };
    touch(&first, 1);
    for key in [2, 3] {
        assert_eq!(get(&cache, key, &[0.0; 1000]).1, Source::Built);
    }
    assert_eq!(get(&cache, 1, &[]).1, Source::Cached, "used, so no longer the oldest");
    let key_2 = folder.path().join("made/on/demand").join(hexadecimal(&name(None, "test", &2u32).unwrap()) + SUFFIX);
    touch(&key_2, 2);
    assert_eq!(get(&cache, 4, &[0.0; 1000]).1, Source::Built);
    assert!(stranger.exists() && !key_2.exists() && first.exists());
    assert_eq!(get(&cache, 2, &[0.0; 1000]).1, Source::Built);
    let sizes = fs::read_dir(folder.path().join("made/on/demand")).unwrap().map(|e| e.unwrap().metadata().unwrap().len());
    assert!(sizes.sum::<u64>() <= 25_000 + 100_000);
}

#[test]
fn writers_at_the_same_time_do_not_meet() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::in_folder(folder.path());
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for key in 0..50 {
                    let model = vec![f64::from(key); 5000];
                    assert_eq!(get(&cache, key, &model).0, model);
                }
            });
        }
    });
    assert!((0..50).all(|key| get(&cache, key, &[]).1 == Source::Cached));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 50);
}

/// Calls `seen` with a copy of `value` for every number in it, changed by the least that a double allows, or by one.
fn each_number_changed(value: &Value, whole: &mut dyn FnMut(Value)) {
    match value {
        Value::Number(number) => {
            let changed = match number.as_i64() {
                Some(integer) => (integer + 1).into(),
                None => number.as_f64().unwrap().next_up().into(),
            };
            whole(changed);
        }
        Value::Array(items) => (0..items.len()).for_each(|i| {
            each_number_changed(&items[i], &mut |item| {
                let mut items = items.clone();
                items[i] = item;
                whole(Value::Array(items));
            });
        }),
        Value::Object(fields) => fields.iter().for_each(|(key, field)| {
            each_number_changed(field, &mut |field| {
                let mut fields = fields.clone();
                fields[key] = field;
                whole(Value::Object(fields));
            });
        }),
        _ => {}
    }
}

#[test]
fn any_number_of_a_design_changes_the_name() {
    let mut design = reference();
    design.heat.mounts.push(Mount { side: Side::Right, conductance: 50.5 });
    design.heat.heaters.push(Heater { side: Side::Right, power: 0.25 });
    design.heat.film = Some(5.5);
    let opening = Opening { side: Side::Right, below: -20.5, hysteresis: 5.5, fraction: 0.25 };
    let row = FactorsAt { temperature: -20.5, transverse_modulus: 1.5, transverse_expansion: 0.5 };
    let all = [
        Mechanics::Opening(opening),
        Mechanics::TemperatureTable(vec![row, row]),
        Mechanics::Relaxing { fraction: 0.25, time: 900.5 },
    ];
    for mechanics in all {
        let design = Design { mechanics, ..design.clone() };
        let key = |design: &Design| name(None, "dynamics", &(design, [Drive::Chamber], STANDARD)).unwrap();
        let (plain, value) = (key(&design), serde_json::to_value(&design).unwrap());
        let same: Design = serde_json::from_value(value.clone()).unwrap();
        assert_eq!((&same, key(&same)), (&design, plain));
        let (mut names, mut count) = (std::collections::HashSet::from([plain]), 0);
        each_number_changed(&value, &mut |changed| {
            count += 1;
            let changed: Design = serde_json::from_value(changed).unwrap();
            assert!(changed != design && names.insert(key(&changed)), "{changed:?}");
        });
        assert!(count > 50, "{count} numbers");
    }
    let key = |drives: &[Drive], fidelity: &Fidelity| name(None, "dynamics", &(&design, drives, fidelity)).unwrap();
    let plain = key(&[Drive::Chamber], &STANDARD);
    assert_ne!(plain, key(&[Drive::Chamber, Drive::Heaters], &STANDARD));
    assert_ne!(plain, key(&[Drive::Chamber], &Fidelity { modes: 41, ..STANDARD }));
}

#[test]
fn a_model_from_the_cache_is_the_model() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::in_folder(folder.path());
    let opening = Opening { side: Side::Right, below: -20.0, hysteresis: 5.0, fraction: 0.5 };
    for mechanics in [Mechanics::Elastic, Mechanics::Relaxing { fraction: 0.5, time: 900.0 }, Mechanics::Opening(opening)] {
        let design = Design { mechanics, ..reference() };
        let get = || {
            let build = || Dynamics::new(&design, &[Drive::Chamber], &QUICK);
            cache.load_or_build("dynamics", &(&design, [Drive::Chamber], QUICK), build).unwrap()
        };
        let ((built, first), (found, second)) = (get(), get());
        assert_eq!((first, second), (Source::Built, Source::Cached));
        assert_eq!(built, found);
        let time: Vec<f64> = (0..50).map(|k| 30.0 * f64::from(k)).collect();
        let profile = Profile { drives: vec![time.iter().map(|t| -t / 30.0).collect()], time };
        assert_eq!(built.simulate(&profile).unwrap(), found.simulate(&profile).unwrap());
    }
}
