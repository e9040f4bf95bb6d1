//! The lecture's offset slider-crank as two bare loop-closure equations in θ3 and x. Lengths in m,
//! angles in rad, time in s.
//!
//! What to see: no body is modelled, only the angle of the coupler and the place of the slider, as
//! in the lecture; Newton's results lie on those by elimination to the last digits. The slider
//! lingers at the far end and turns sharply at the near one; since its line passes above the
//! crank's pin, its way there and its way back are not alike.
//!
//! `cargo run --release --example 01_slider_crank`

use kin::prelude::*;
use kin_view::{Figure, Outline, Panel, Scene};

const OUT: &str = "out/01_slider_crank";

// 1. Geometry: crank, coupler, height of the slider's line over the crank's pin.
const L2: f64 = 0.1; // m
const L3: f64 = 0.4; // m
const H: f64 = 0.03; // m
const OMEGA: f64 = TAU; // rad/s: one turn a second

// 2. Constraints: the loop closes, with the crank at θ2 = ω t.
/// Loop closure of the offset slider-crank (lecture, "Classical Approach").      [m]
#[constraint]
fn slider_crank(
    theta3: Coord,
    x: Coord,
    t: Time,
    l2: f64,
    l3: f64,
    h: f64,
    omega: f64,
) -> [f64; 2] {
    let theta2 = omega * t;
    [l2 * theta2.cos() + l3 * theta3.cos() - x, l2 * theta2.sin() + l3 * theta3.sin() - h]
}

/// θ3, x and their first and second rates by elimination, θ3 = asin((h − l2 sin θ2)/l3), and by
/// hand from there.
fn elimination(t: f64) -> [f64; 6] {
    let (sin2, cos2) = (OMEGA * t).sin_cos();
    let theta3 = ((H - L2 * sin2) / L3).asin();
    let (sin3, cos3) = theta3.sin_cos();
    let w3 = -L2 * OMEGA * cos2 / (L3 * cos3);
    let alpha3 = (L2 * OMEGA * OMEGA * sin2 + L3 * w3 * w3 * sin3) / (L3 * cos3);
    let v = -L2 * OMEGA * sin2 - L3 * w3 * sin3;
    let a = -L2 * OMEGA * OMEGA * cos2 - L3 * alpha3 * sin3 - L3 * w3 * w3 * cos3;
    [theta3, L2 * cos2 + L3 * cos3, w3, v, alpha3, a]
}

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("slider-crank");
    let ground = m.ground();
    let theta3 = m.angle("theta3", 0.0)?; // a guess, rad: it chooses the assembly with cos θ3 > 0
    let x = m.length("x", L2 + L3)?; // a guess, m
    m.add("loop", slider_crank(theta3, x, L2, L3, H, OMEGA))?;

    // 3. Motion: one turn of the crank, a degree at a time.
    m.write_json(format!("{OUT}/mechanism.json"))?;
    let system = m.build()?;
    let mut motion = system.run(linspace(0.0, 1.0, 361))?;
    println!("{}\n", motion.summary());

    // 4. Results: Newton beside elimination.
    let coupler = motion.coordinate(theta3)?;
    let slider = motion.coordinate(x)?;
    let by_newton = [
        &coupler.value,
        &slider.value,
        &coupler.rate,
        &slider.rate,
        &coupler.second_rate,
        &slider.second_rate,
    ];
    let by_hand: Vec<[f64; 6]> = motion.times().iter().map(|&t| elimination(t)).collect();
    println!(
        "{:18} {:>9} {:>9}  {:14} from elimination, at most",
        "over one turn", "least", "greatest", "at crank angle"
    );
    for (k, q) in by_newton.iter().enumerate() {
        let difference = q
            .values()
            .iter()
            .zip(&by_hand)
            .map(|(newton, hand)| (newton - hand[k]).abs())
            .fold(0.0, f64::max);
        let name = format!("{} [{}]", q.name(), q.unit());
        let degrees = 360.0 * q.at_max();
        let unit = q.unit();
        println!(
            "{name:18} {:9.5} {:9.5}  {degrees:3.0} deg        {difference:.0e} {unit}",
            q.min(),
            q.max()
        );
    }

    for (k, (name, unit)) in
        [("theta3 by elimination", "rad"), ("x by elimination", "m")].into_iter().enumerate()
    {
        motion.add_output(name, unit, by_hand.iter().map(|row| row[k]).collect())?;
    }
    // Where the pins are: the crank's from the angle that drives it, the slider's from x.
    let pin: Vec<Vec2> =
        motion.times().iter().map(|t| vec2((OMEGA * t).cos(), (OMEGA * t).sin()) * L2).collect();
    let end: Vec<Vec2> = slider.value.values().iter().map(|x| vec2(*x, H)).collect();
    for (name, values) in
        [("slider.x", end.iter().map(|p| p.x).collect()), ("slider.y", vec![H; end.len()])]
    {
        motion.add_output(name, "m", values)?;
    }
    motion.write_csv(format!("{OUT}/motion.csv"))?;

    // 5. Figures: elimination every 15 degrees on top of Newton's line.
    let by_hand = motion.outputs(); // θ3, x
    let positions = vec![
        Panel::over_time("Coupler", "angle").series("Newton", &coupler.value).dots(
            "elimination",
            &by_hand[0],
            15,
        ),
        Panel::over_time("Slider", "position").series("Newton", &slider.value).dots(
            "elimination",
            &by_hand[1],
            15,
        ),
    ];
    let rates = vec![
        Panel::over_time("Coupler", "angular velocity").series("theta3'", &coupler.rate),
        Panel::over_time("Slider", "velocity").series("x'", &slider.rate),
        Panel::over_time("Coupler", "angular acceleration")
            .series("theta3''", &coupler.second_rate),
        Panel::over_time("Slider", "acceleration").series("x''", &slider.second_rate),
    ];
    Figure::new(positions).save(format!("{OUT}/positions.svg"))?;
    Figure::new(rates).save(format!("{OUT}/rates.svg"))?;

    // 6. The mechanism: lines through the pins, since there are no bodies to be drawn.
    let scene =
        Scene::new(&system).line("crank", &[&[vec2(0.0, 0.0)], &pin]).line("slider", &[&pin, &end]);
    let scene = scene.outline(ground, Outline::line([vec2(0.25, H), vec2(0.55, H)]));
    scene.animated(&motion, 3.0)?.save(format!("{OUT}/animated.svg"))?;
    scene.page(&motion)?.coordinate("Slider", &slider).save(format!("{OUT}/index.html"))?;
    println!("\nwrote {OUT}/: motion.csv, index.html, animated.svg, positions.svg, rates.svg");
    Ok(())
}
