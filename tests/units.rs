//! A mechanism says what its units are called; files, pages and messages say it after it.

#[path = "data/engines.rs"]
mod engines;

use kin::SolverOptions;
use kin::data::MotionData;
use kin::data::Registry;
use kin::error::FailureKind;
use kin::joints::drivers::drive_distance;
use kin::prelude::*;
use kin::results::Units;
use kin_view::{Figure, Panel, Scene};

use engines::Engines;

/// A crank of 15 and a rod of 40 on a slider, in millimetres and milliseconds; `reach` is how far
/// the slider is pushed.
fn slider(reach: f64) -> kin::Result<(Mechanism, Link)> {
    let mut m = Mechanism::new("slider");
    m.units("mm", "ms");
    let ground = m.ground();
    let crank = m.link("crank", 15.0)?;
    let rod = m.link("rod", 40.0)?;
    let slider = m.planar("slider", pose(40.0, 0.0, 0.0))?;
    m.add("O", revolute(ground, crank, vec2(0.0, 10.0), crank.start()))?;
    m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
    m.add("B", revolute(rod, slider, rod.end(), vec2(0.0, 0.0)))?;
    m.add("guide", prismatic(slider, ground, vec2(0.0, 0.0), vec2(0.0, 0.0), vec2(0.0, 1.0), 0.0))?;
    m.add("motor", drive(slider.x(), Law::linear(40.0, reach)))?;
    m.prefer(crank, deg(60.0));
    m.limit("slider.R_x", 0.0, 42.0)?;
    Ok((m, rod))
}

/// No metre, and no second, as a unit of its own.
fn no_metre(text: &str) {
    for wrong in
        ["[m]", "[s]", "[m/", "/s]", "/s^", " m ", " m.", " m;", " s:", " s ", " s.", " s,", " s;"]
    {
        assert!(!text.contains(wrong), "`{wrong}` in: {text}");
    }
}

#[test]
fn headers_series_and_measures_have_the_words_of_the_mechanism() -> kin::Result<()> {
    let (m, rod) = slider(5.0)?;
    let system = m.build()?;
    let mut motion =
        system.run_both_with(linspace(0.0, 1.0, 11), &SolverOptions::new().jerk(true))?;
    motion.add_point("P", rod, rod.end())?;
    let headers = motion.headers();
    headers.iter().for_each(|header| no_metre(header));
    for wanted in [
        "t [ms]",
        "rod.R_x [mm]",
        "rod.R_x' [mm/ms]",
        "rod.theta'' [rad/ms^2]",
        "slider.R_x''' [mm/ms^3]",
        "P.x [mm]",
        "P.y'' [mm/ms^2]",
    ] {
        assert!(headers.iter().any(|header| header == wanted), "{wanted} in {headers:?}");
    }
    assert_eq!((system.coordinate_units()[0].as_str(), motion.units()[2].as_str()), ("mm", "rad"));
    let slide = system.measure(&motion, "guide.slide")?;
    assert_eq!(
        (slide.value.unit(), slide.rate.unit(), slide.third_rate.unit()),
        ("mm", "mm/ms", "mm/ms^3")
    );
    let point = motion.point(rod, rod.end())?;
    assert_eq!(
        (point.speed().unit().to_string(), point.jerk_magnitude().unit().to_string()),
        ("mm/ms".into(), "mm/ms^3".into())
    );
    let angle = motion.relative_angle(rod, kin::Ground)?;
    assert_eq!((angle.value.unit(), angle.rate.unit()), ("rad", "rad/ms"));
    Ok(())
}

#[test]
fn pages_and_charts_have_the_words_of_the_mechanism() -> kin::Result<()> {
    let (m, rod) = slider(5.0)?;
    let system = m.build()?;
    let motion = system.run_both(linspace(0.0, 1.0, 11))?;
    let x = motion.named("slider.R_x")?;
    let page = Scene::new(&system).page(&motion)?.coordinate("Slider", &x).html();
    for wanted in ["\"units\":[\"mm\",\"ms\"]", "\"unit\":\"mm/ms²\""] {
        assert!(page.contains(wanted), "{wanted}");
    }
    assert!(
        !page.contains("} m`") && !page.contains("} s`") && !page.contains("} seconds"),
        "the script writes metres or seconds by itself"
    );
    assert!(Scene::new(&system).pose(&motion, 0.5)?.svg().contains("t = 0.5 ms<"));
    let path = motion.point(rod, rod.end())?;
    let plane = Panel::plane("path").in_units(motion.unit_words()).path("B", path.r());
    let svg =
        Figure::new([Panel::over_time("slider", "velocity").series("x", &x.rate), plane]).svg();
    no_metre(&svg);
    for wanted in ["t [ms]", "velocity [mm/ms]", "x [mm]", "y [mm]"] {
        assert!(svg.contains(wanted), "{wanted}");
    }
    Ok(())
}

#[test]
fn proofs_events_diagnoses_and_errors_have_the_words_of_the_mechanism() -> kin::Result<()> {
    let (m, _) = slider(5.0)?;
    let system = m.build()?;
    let motion = system.run_both(linspace(0.0, 1.0, 11))?;
    let proof = system.prove(&motion)?.to_string();
    assert!(proof.contains("From t = 0 ms to 1 ms") && proof.contains(" mm and "), "{proof}");
    no_metre(&proof);
    let event = motion.events().first().expect("the slider passes 42 mm").to_string();
    assert_eq!(event, "t = 0.4 ms: `slider.R_x` passes the upper limit, 42 mm");
    assert!(system.diagnose(0.0)?.to_string().contains("at t = 0 ms: "));
    let outside = system.at(&motion, 2.0).unwrap_err().to_string();
    assert_eq!(outside, "times: t = 2 ms is outside of the motion, which goes from 0 ms to 1 ms");

    // Crank and rod are in line where the slider stands at √((15 + 40)² − 10²) = 54.08 mm.
    let (m, _) = slider(20.0)?;
    let system = m.build()?;
    let error = system.run_both(linspace(0.0, 1.0, 41)).unwrap_err();
    let text = error.to_string();
    assert!(
        matches!(error.kind(), Some(FailureKind::Toggle { .. }))
            && text.contains("t = 0.704")
            && text.contains("toggle at t = "),
        "{text}"
    );
    assert!(text.contains(" ms is in this error"), "{text}");
    no_metre(&text);
    no_metre(&system.run_both([1.0]).unwrap_err().to_string());
    Ok(())
}

#[test]
fn words_come_back_from_json_and_old_files_are_in_metres() -> kin::Result<()> {
    let (m, _) = slider(5.0)?;
    let data = m.data()?;
    let again = Mechanism::from_data(&data, &Registry::new())?.build()?;
    assert_eq!(*again.unit_words(), Units::new("mm", "ms"));
    let motion = again.run_both(linspace(0.0, 1.0, 3))?;
    let json = serde_json::to_string(&motion.data()).unwrap();
    assert!(json.contains(r#""units":{"length":"mm","time":"ms"}"#), "{json}");
    let back = Motion::from_data(&serde_json::from_str::<MotionData>(&json).unwrap())?;
    assert_eq!(back.headers(), motion.headers());
    assert_eq!(back.events(), motion.events());
    let diagnosis = again.diagnose(0.0)?;
    let diagnosis_back: kin::diagnosis::Diagnosis =
        serde_json::from_str(&serde_json::to_string(&diagnosis).unwrap()).unwrap();
    assert_eq!(diagnosis_back.to_string(), diagnosis.to_string());

    // A file that says nothing, as all that have been written so far.
    let mut plain = serde_json::to_value(&data).unwrap();
    plain.as_object_mut().unwrap().remove("units");
    let old = Mechanism::from_data(&serde_json::from_value(plain).unwrap(), &Registry::new())?;
    assert!(old.build()?.run_both([0.0])?.headers()[1].ends_with("[m]"));
    Ok(())
}

#[test]
fn a_unit_without_a_word_is_refused() {
    for (length, time, what) in [
        (" ", "s", "a unit of length has an empty name. Give the unit of length a name"),
        ("mm", "", "a unit of time has an empty name. Give the unit of time a name"),
    ] {
        let mut m = Mechanism::new("empty");
        m.units(length, time);
        let body = m.planar("body", pose(0.0, 0.0, 0.0)).unwrap();
        m.add(
            "rod",
            drive_distance(body, m.ground(), vec2(1.0, 0.0), vec2(0.0, 0.0), Law::constant(1.0)),
        )
        .unwrap();
        assert_eq!(m.build().unwrap_err().to_string(), what);
    }
}
