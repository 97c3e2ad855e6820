//! `palpate quality`: runs in real time, so numbers of the machine are not asserted.

use crate::{json, palpate, stderr, stdout};

/// Judge: counts that hold on any machine; ticks that were done and left out fill the time.
#[test]
#[ignore = "long"]
fn a_run_per_rate_with_every_tool() {
    let answer = json(&palpate(&[
        "quality",
        "--rates",
        "500,1000",
        "--seconds",
        "2",
        "--json",
    ]));
    assert_eq!(answer["palpate"], env!("CARGO_PKG_VERSION"));
    let runs = answer["runs"].as_array().unwrap();
    for (run, rate) in runs.iter().zip([500.0, 1000.0]) {
        assert_eq!(run["asked_hz"], rate);
        let tools = run["tools"].as_array().unwrap();
        assert_eq!(tools.len(), 2);
        for tool in tools {
            let ticks = tool["ticks"].as_f64().unwrap() + tool["missed"].as_f64().unwrap();
            // Two seconds, and what the first and the last of them were late.
            assert!((0.8..1.5).contains(&(ticks / (2.0 * rate))), "{run}");
            let lateness = &tool["lateness_s"];
            let at = |name: &str| lateness[name].as_f64().unwrap();
            assert!(at("p50") <= at("p99") && at("p99") <= at("p99_9"));
            assert!(at("p99_9") <= at("max"));
            // Scripted hands press nothing: the most that they may have is half.
            assert!(tool["peak_force_n"].as_f64().unwrap() <= 1.5);
            let faults = tool["faults"].as_u64().unwrap();
            assert!(faults > 0 || tool.get("fault").is_none(), "{run}");
            for stage in [
                "dead_man_released",
                "damped",
                "walls",
                "saturated",
                "thermally_limited",
            ] {
                assert_eq!(tool["limited_ticks"][stage], 0, "{stage}: {run}");
            }
        }
        let model = &run["model"];
        assert!(model["extrapolation_peak_n"].as_f64().unwrap() > 0.0);
    }
    assert_eq!(runs.len(), 2);
}

#[test]
fn a_person_reads_it_and_bad_input_is_answered() {
    let output = palpate(&["quality", "--rates", "1000", "--seconds", "1"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    for word in [
        "1000 Hz requested",
        "jitter",
        "energy",
        "limits",
        "extrapolation error",
    ] {
        assert!(stdout(&output).contains(word), "{}", stdout(&output));
    }
    for wrong in [["--rates", "5"], ["--rates", "fast"], ["--seconds", "0"]] {
        let output = palpate(&["quality", wrong[0], wrong[1]]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(wrong[0]), "{}", stderr(&output));
    }
    let output = palpate(&["quality", "nowhere.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("nowhere.toml"));
}
