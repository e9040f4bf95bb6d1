//! Axes of charts, whatever the size of their numbers.

use super::*;

/// Numbers from the smallest to the largest: every picture ends, and holds numbers only.
#[test]
fn numbers_of_any_size_make_a_picture() {
    let sizes =
        [0.0, f64::from_bits(1), 1e-308, 1e-150, 1e-9, 1.0, 1e15, 1e101, 1e200, 1e308, f64::MAX];
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let panels = |points: &[Vec2]| {
        let kinds = [
            Panel::over_time("t", "q"),
            Panel::log_over_time("t", "q"),
            Panel::plane("p"),
            Panel::numbers("n", "x", "y"),
        ];
        kinds.map(|panel| panel.path("p", points).scatter("s", points).sketch(points))
    };
    for a in sizes {
        for b in sizes.into_iter().chain(odd) {
            for points in [
                vec![vec2(0.0, a), vec2(1.0, b)],
                vec![vec2(-a, -b), vec2(b, a), vec2(a, a)],
                vec![vec2(a, b)],
            ] {
                let svg = Figure::new(panels(&points)).svg();
                parsed(&svg);
                assert!(
                    !svg.contains("NaN") && !svg.contains(">inf") && svg.len() < 300_000,
                    "{a:e} {b:e}: {} bytes",
                    svg.len()
                );
            }
        }
    }
    for values in [[0.0, 1e308, -1e308, 1.0], [f64::NAN, f64::MAX, f64::MIN, f64::INFINITY]] {
        let map = Map::new("m", "q")
            .along_x("x", -1e308, 1e308, 2)
            .along_y("y", f64::NAN, 1.0, 2)
            .values(values);
        parsed(&map.svg());
        assert!(!map.svg().contains("NaN") && !map.svg().contains("inf<"), "{}", map.svg());
    }
}

/// Far axes keep their numbers: the label says what they are multiplied by.
#[test]
fn an_axis_of_large_numbers_says_their_power() {
    let points = [vec2(0.0, 1e200), vec2(1.0, 3e200)];
    assert!(
        Figure::new([Panel::numbers("n", "x", "y").path("p", &points)]).svg().contains("y · 1e200")
    );
    let log =
        Figure::new(
            [Panel::log_over_time("t", "q").path("p", &[vec2(0.0, 1.0), vec2(1.0, 1e308)])],
        )
        .svg();
    assert!(log.contains("log₁₀ q"), "{log}");
    assert!(
        !Figure::new(
            [Panel::log_over_time("t", "q").path("p", &[vec2(0.0, 1.0), vec2(1.0, 1e12)])]
        )
        .svg()
        .contains("log₁₀")
    );
}
