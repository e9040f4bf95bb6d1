//! A small drawing of each joint, from a few strokes: body i blue, body j grey, what is driven
//! orange.

use std::fmt::Write;

/// Strokes, one a word and its points: `i`, `j` bodies, `I`, `J` filled ones, `a` an axis, `t` a
/// thin line, `o` an open circle (a pin or ball), `d` a dot, `c`, `k` a circle of body i, j, `>` a
/// driven way, `@` a driven turn, `g` the ground, `q`, `w` a curve of body j, i.
const STROKES: &[(Option<bool>, &str, &str)] = &[
    (None, "fixed", "g 24,44 72,44; I 32,20 64,20 64,44 32,44"),
    (None, "weld", "i 10,40 48,26; j 86,40 48,26; I 42,20 54,20 54,32 42,32"),
    (Some(false), "revolute", "i 12,44 48,22; j 84,44 48,22; o 48,22 5"),
    (
        Some(false),
        "prismatic",
        "j 8,34 88,34; I 34,26 62,26 62,42 34,42; i 48,26 48,8; t 34,20 62,20",
    ),
    (None, "distance", "i 8,46 22,20; j 88,46 74,24; t 22,20 74,24; o 22,20 4; o 74,24 4"),
    (Some(false), "angle", "j 14,44 84,44; i 14,44 72,12; w 50,44 50,34 44,28"),
    (Some(false), "parallel", "i 14,16 82,16; j 14,36 82,36; d 82,16 3; d 82,36 3"),
    (Some(false), "point_on_line", "t 8,46 88,14; i 48,6 48,30; d 48,30 4"),
    (Some(false), "pin_in_slot", "J 10,24 86,24 86,36 10,36; i 40,4 40,30; o 40,30 5"),
    (Some(false), "point_on_circle", "k 46,34 18; i 82,6 60,22; d 60,22 4; d 46,34 2"),
    (Some(false), "point_on_curve", "q 8,16 46,62 88,12; i 40,6 44,38; d 44,38 4"),
    (
        Some(false),
        "cam_knife_edge",
        "k 48,40 14; d 48,42 2; i 48,4 48,18; i 42,10 48,26; i 54,10 48,26",
    ),
    (Some(false), "cam_flat_face", "k 48,42 13; d 48,44 2; i 48,4 48,28; i 26,28 70,28"),
    (Some(false), "cam_roller", "k 48,44 11; d 48,46 2; c 48,25 7; i 48,4 48,25; d 48,25 2"),
    (Some(false), "gear", "c 32,28 18; k 64,28 14; a 32,28 64,28; d 32,28 2; d 64,28 2"),
    (Some(false), "internal_gear", "k 48,28 25; c 35,28 12; a 35,28 48,28; d 35,28 2; d 48,28 2"),
    (
        Some(false),
        "belt",
        "c 22,28 12; k 74,28 8; t 23,16 75,20; t 23,40 75,36; d 22,28 2; d 74,28 2",
    ),
    (None, "rack_and_pinion", "j 8,44 88,44; t 8,40 88,40; c 48,24 16; d 48,24 2"),
    (Some(false), "rolling", "j 8,46 88,46; c 44,28 18; d 44,28 2; i 44,28 56,16"),
    (
        Some(false),
        "coupling",
        "I 10,20 34,20 34,38 10,38; J 62,20 86,20 86,38 62,38; t 34,29 62,29",
    ),
    (
        Some(false),
        "linear_coupling",
        "I 6,8 28,8 28,24 6,24; I 6,34 28,34 28,50 6,50; J 66,20 88,20 88,38 66,38; t 28,16 48,29; t 28,42 48,29; t 48,29 66,29; d 48,29 3",
    ),
    (
        None,
        "moving_point",
        "I 10,14 86,14 86,44 10,44; t 20,36 44,22 76,24; d 44,22 4; > 44,22 66,18",
    ),
    (
        None,
        "point_on_path",
        "I 10,14 86,14 86,44 10,44; q 18,38 48,8 78,38; o 48,23 4; j 48,23 48,4",
    ),
    (Some(true), "spherical", "i 10,44 42,28; j 86,44 50,24; k 48,26 10; o 47,26 6"),
    (Some(true), "point_on_line", "a 8,46 88,14; i 48,4 48,28; o 48,30 6"),
    (Some(true), "point_in_plane", "J 6,46 30,26 90,26 66,46; i 48,4 48,32; o 48,34 6"),
    (
        Some(true),
        "point_coordinate",
        "t 12,48 12,8; t 12,48 84,48; i 78,8 56,22; d 56,22 4; t 56,22 12,22",
    ),
    (Some(true), "parallel", "a 22,50 46,6; a 52,50 76,6; i 28,39 40,17; j 58,39 70,17"),
    (Some(true), "perpendicular", "i 20,44 76,44; j 48,44 48,8; t 56,44 56,36 48,36"),
    (Some(true), "angle", "j 14,44 84,44; i 14,44 72,12; t 50,44 46,27"),
    (
        Some(true),
        "revolute",
        "a 48,4 48,52; I 40,12 56,12 56,28 40,28; J 40,28 56,28 56,44 40,44; i 40,20 10,20; j 56,36 86,36",
    ),
    (
        Some(true),
        "prismatic",
        "j 6,32 90,32; j 6,26 90,26; I 32,20 58,20 58,38 32,38; I 32,20 38,14 64,14 58,20; i 50,14 50,2",
    ),
    (
        Some(true),
        "cylindrical",
        "a 4,30 92,30; j 8,30 88,30; I 34,22 62,22 62,38 34,38; i 48,22 48,4",
    ),
    (
        Some(true),
        "universal",
        "i 6,34 34,30; j 90,34 62,30; t 34,30 62,30; t 48,16 48,44; d 34,30 3; d 62,30 3; d 48,16 3; d 48,44 3",
    ),
    (Some(true), "planar", "J 4,48 28,30 92,30 68,48; I 30,38 44,26 72,26 58,38; i 52,26 52,6"),
    (
        Some(true),
        "screw",
        "a 48,2 48,54; t 40,14 56,20; t 40,22 56,28; t 40,30 56,36; t 40,38 56,44; I 32,24 64,24 64,34 32,34; j 48,10 48,48",
    ),
    (
        Some(true),
        "constant_velocity",
        "i 6,40 40,30; j 90,40 56,30; k 48,28 12; t 40,30 56,30; t 48,18 48,38",
    ),
    (
        Some(true),
        "relative_angle",
        "a 48,4 48,52; i 48,28 86,20; j 48,28 84,42; w 74,23 78,30 74,37; d 48,28 3",
    ),
    (
        Some(true),
        "gear",
        "I 20,12 40,19 40,33 20,40; J 20,41 92,41 72,34 40,34; a 8,26 56,26; a 56,6 56,52",
    ),
    (
        Some(true),
        "gear_by_radii",
        "a 26,4 26,52; a 66,4 66,52; I 8,20 44,20 44,36 8,36; J 44,20 88,20 88,36 44,36; t 44,14 44,42; > 44,12 44,4",
    ),
    (
        Some(true),
        "thread",
        "a 4,30 92,30; j 8,30 88,30; t 34,22 40,38; t 42,22 48,38; t 50,22 56,38; t 58,22 64,38; i 48,20 48,4; w 20,20 28,30 20,40",
    ),
    (
        Some(true),
        "revolute_spherical",
        "i 8,46 20,22; a 20,6 20,40; I 14,14 26,14 26,30 14,30; t 26,22 70,26; o 74,26 6; j 80,28 92,46",
    ),
    (
        Some(true),
        "revolute_revolute",
        "a 18,4 18,42; a 66,46 86,10; I 12,14 24,14 24,30 12,30; t 24,22 74,28; J 70,22 82,26 78,38 66,34",
    ),
    (
        Some(true),
        "revolute_cylindrical",
        "a 18,4 18,42; I 12,14 24,14 24,30 12,30; t 24,22 74,26; j 60,50 88,2; J 68,24 76,18 84,28 76,34",
    ),
    (
        Some(true),
        "spherical_cylindrical",
        "i 8,46 18,24; o 20,22 6; t 26,22 70,26; j 60,50 88,2; J 68,24 76,18 84,28 76,34",
    ),
    (Some(false), "drive", "i 16,30 60,30; > 60,30 84,30; d 16,30 3"),
    (None, "drive_angle", "g 24,48 72,48; i 48,36 84,14; o 48,36 5; @ 48,36 18"),
    (None, "drive_relative_angle", "j 10,46 44,34; i 44,34 84,14; o 44,34 5; @ 44,34 18"),
    (None, "drive_slide", "j 8,36 88,36; I 22,28 46,28 46,44 22,44; > 46,22 78,22; t 46,22 34,22"),
    (
        None,
        "drive_distance",
        "i 8,48 20,26; j 88,48 76,26; J 28,22 56,22 56,32 28,32; t 20,27 76,27; o 20,27 4; o 76,27 4; > 56,14 74,14",
    ),
    (None, "drive_point", "q 16,24 46,2 84,26; i 8,48 40,14; d 40,14 4; > 40,14 58,13"),
    (None, "drive_point_along", "i 8,48 52,26; d 52,26 4; t 52,52 52,6; > 52,26 52,8"),
    (Some(true), "drive_turn", "a 48,2 48,54; i 48,28 86,20; j 48,36 12,44; o 48,28 5; @ 48,28 20"),
    (Some(true), "drive_rotation", "a 20,52 76,4; I 34,22 56,16 62,34 40,40; @ 48,28 22"),
    (
        Some(true),
        "drive_orientation",
        "I 34,20 62,20 62,38 34,38; t 48,29 84,29; t 48,29 48,4; t 48,29 28,50; @ 48,29 22; > 78,29 88,29",
    ),
    (
        Some(true),
        "drive_motion",
        "t 10,48 10,30; t 10,48 28,48; t 10,48 20,40; q 14,44 40,2 62,24; I 54,14 80,14 80,32 54,32; t 62,24 84,24; t 62,24 62,6; > 78,38 88,46; @ 66,24 20",
    ),
];

/// The strokes of a joint, which may be one of the plane or of space alone.
fn strokes(group: &str, name: &str) -> Option<&'static str> {
    let spatial = group.starts_with("spatial");
    let found = STROKES
        .iter()
        .find(|(space, known, _)| *known == name && space.is_none_or(|space| space == spatial));
    found.map(|(_, _, strokes)| *strokes)
}

/// The drawing as SVG; `None` for a joint that nobody has drawn.
pub fn svg(group: &str, name: &str) -> Option<String> {
    let mut text = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 96 56\" width=\"96\" height=\"56\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
    );
    for stroke in strokes(group, name)?.split(';') {
        let (word, rest) = stroke.trim().split_once(' ')?;
        let numbers: Vec<f64> =
            rest.split([' ', ',']).map(|number| number.parse().expect("a number")).collect();
        text += &drawn(word, &numbers);
    }
    text += "</svg>\n";
    Some(text)
}

fn drawn(word: &str, n: &[f64]) -> String {
    let points: Vec<String> =
        n.chunks(2).map(|p| p.iter().map(f64::to_string).collect::<Vec<_>>().join(",")).collect();
    let points = points.join(" ");
    let line = |color: &str, width: f64, more: &str| {
        format!(
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"{more}/>\n"
        )
    };
    let area = |fill: &str, color: &str| {
        format!(
            "<polygon points=\"{points}\" fill=\"{fill}\" stroke=\"{color}\" stroke-width=\"1.5\"/>\n"
        )
    };
    let round = |fill: &str, color: &str| {
        format!(
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{fill}\" stroke=\"{color}\" stroke-width=\"1.5\"/>\n",
            n[0], n[1], n[2]
        )
    };
    let curve = |color: &str| {
        format!(
            "<path d=\"M{},{} Q{},{} {},{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>\n",
            n[0], n[1], n[2], n[3], n[4], n[5]
        )
    };
    let (i, j, drive) = ("#2563eb", "#6b7280", "#ea580c");
    match word {
        "i" => line(i, 3.0, ""),
        "j" => line(j, 3.0, ""),
        "I" => area("#bfdbfe", i),
        "J" => area("#e5e7eb", j),
        "a" => line("#111827", 0.8, " stroke-dasharray=\"5 2 1 2\""),
        "t" => line("#111827", 1.2, ""),
        "o" => round("#ffffff", "#111827"),
        "d" => round("#111827", "#111827"),
        "c" => round("none", i),
        "k" => round("none", j),
        "q" => curve(j),
        "w" => curve(i),
        ">" => line(drive, 2.0, "") + &head(n[2], n[3], n[2] - n[0], n[3] - n[1], drive),
        "@" => arc(n, drive),
        "g" => line("#111827", 2.0, "") + &hatch(n),
        other => panic!("no stroke is called {other}"),
    }
}

/// An arrow that turns.
fn arc(n: &[f64], drive: &str) -> String {
    let x = n[0];
    let y = n[1];
    let r = n[2];
    let arc = format!(
        "<path d=\"M{},{} A{r},{r} 0 0 0 {},{}\" fill=\"none\" stroke=\"{drive}\" stroke-width=\"2\"/>\n",
        x + r,
        y,
        x,
        y - r
    );
    arc + &head(x, y - r, -1.0, 0.0, drive)
}

/// Strokes below the line of the ground.
fn hatch(n: &[f64]) -> String {
    let mut text = String::new();
    let mut x = n[0];
    while x < n[2] {
        let _ = writeln!(
            text,
            "<path d=\"M{x},{} l-5,6\" stroke=\"#111827\" stroke-width=\"1\"/>",
            n[1]
        );
        x += 6.0;
    }
    text
}

/// The head of an arrow that ends at (x, y).
fn head(x: f64, y: f64, dx: f64, dy: f64, color: &str) -> String {
    let length = dx.hypot(dy);
    let u = dx / length * 4.0;
    let v = dy / length * 4.0;
    format!(
        "<polygon points=\"{:.1},{:.1} {:.1},{:.1} {:.1},{:.1}\" fill=\"{color}\"/>\n",
        x + u,
        y + v,
        x - 0.6 * u - 0.8 * v,
        y - 0.6 * v + 0.8 * u,
        x - 0.6 * u + 0.8 * v,
        y - 0.6 * v - 0.8 * u
    )
}
