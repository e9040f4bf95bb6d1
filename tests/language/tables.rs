//! Tables of pieces, searched in the ways in which programs search them: the piece is the one that
//! rustc's reading finds, and it is looked up (`kin-macros` looks at what is emitted of each).

use crate::twice;

twice! { Symbolic from_its_end(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const PIECES: [[f64; 5]; 8] = [
        [-2.0, 0.5, 0.0, 0.25, -0.1],
        [-1.5, 0.0, 1.0, -0.5, 0.2],
        [-1.0, -0.25, 0.0, 0.0, 0.0],
        [-0.5, 1.0, -1.0, 0.3, 0.7],
        [0.0, 2.0, 0.5, -2.0, 0.0],
        [0.5, 0.75, 0.0, 0.0, 1.0],
        [1.0, -1.0, -2.0, 4.0, -0.3],
        [1.5, 0.3, 0.1, 0.2, 0.4],
    ];
    for k in (0..8).rev() {
        let [begin, a, b, c, d] = PIECES[k];
        if x >= begin || k == 0 {
            let s = x - begin;
            return y - (a + s * (b + s * (c + s * d)));
        }
    }
    0.0
} }

twice! { Symbolic by_find(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    struct Segment { end: f64, value: f64, slope: f64 }
    const SEGMENTS: [Segment; 5] = [
        Segment { end: -1.0, value: 0.5, slope: 0.3 }, Segment { end: -0.5, value: 0.7, slope: 0.2 },
        Segment { end: 0.25, value: 0.1, slope: -0.3 }, Segment { end: 1.0, value: 0.0, slope: 1.0 },
        Segment { end: 9.0, value: 0.5, slope: 0.9 },
    ];
    let segment = SEGMENTS.iter().find(|s| x <= s.end).unwrap_or(&SEGMENTS[4]);
    y - (segment.value + segment.slope * x)
} }

twice! { Symbolic by_windows(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const TABLE: [(f64, f64); 6] = [(-2.0, 0.0), (-1.0, 0.5), (-0.3, 0.7), (0.4, 0.1), (1.1, -0.6), (2.0, 0.2)];
    for w in TABLE.windows(2) {
        let (x0, y0) = w[0];
        let (x1, y1) = w[1];
        if x >= x0 && x < x1 {
            return y - (y0 + (y1 - y0) * (x - x0) / (x1 - x0));
        }
    }
    y
} }

twice! { Symbolic by_while(coord coord ([-2.0, -1.5, -1.25, -0.5, 0.25, 0.5, 1.0, 1.25, 2.0]) ([0.5, -0.25, 0.75, 1.0, -1.0, 0.3, 0.2, 0.6, 0.8])): fn f(x: Coord, y: Coord, knots: [f64; 9], values: [f64; 9]) -> f64 {
    let mut k = 0;
    while k < 7 && x >= knots[k + 1] {
        k += 1;
    }
    let s = (x - knots[k]) / (knots[k + 1] - knots[k]);
    y - ((1.0 - s) * values[k] + s * values[k + 1])
} }

twice! { Symbolic by_position(coord): fn f(x: Coord) -> f64 {
    let knots = [-1.0, 0.0, 1.0, 1.5];
    let levels = [0.25, 0.5, 0.75, 1.0, 2.0];
    let k = knots.iter().position(|&knot| x < knot).unwrap_or(knots.len());
    x * levels[k] - 0.1
} }

twice! { Symbolic by_partition(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const KNOTS: [f64; 5] = [-1.0, -0.5, 0.0, 1.0, 1.5];
    const A: [f64; 6] = [0.25, 0.5, 0.75, 1.0, 2.0, 3.0];
    let k = KNOTS.partition_point(|&knot| knot <= x);
    y - A[k] * x.sin()
} }

twice! { Symbolic by_last(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const BEGIN: [f64; 6] = [-2.0, -1.0, 0.0, 0.5, 1.0, 1.5];
    const A: [f64; 6] = [0.25, 0.5, 0.75, 1.0, 2.0, 3.0];
    let mut k = 0;
    for (j, &b) in BEGIN.iter().enumerate() {
        if x >= b { k = j; }
    }
    y - A[k] * (x - BEGIN[k])
} }

twice! { Symbolic by_break(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const X: [f64; 7] = [-2.0, -1.0, -0.5, 0.0, 0.6, 1.5, 2.5];
    const Y: [f64; 7] = [0.0, 1.0, 0.5, 2.0, 1.0, 0.3, 0.9];
    let mut value = Y[0];
    for k in 1..X.len() {
        if x > X[k - 1] {
            let s = ((x - X[k - 1]) / (X[k] - X[k - 1])).min(1.0);
            value = Y[k - 1] + s * (Y[k] - Y[k - 1]);
        } else {
            break;
        }
    }
    y - value
} }

// Rows and columns, each by its own search.
twice! { Symbolic by_cell(coord coord coord): fn f(x: Coord, y: Coord, z: Coord) -> f64 {
    const GRID: [[f64; 5]; 5] = [[0.0, 1.0, 0.5, 0.1, 0.2], [1.0, 2.0, 0.0, 0.3, 0.4], [0.5, 1.5, 1.0, 0.7, 0.9], [0.2, 0.3, 0.4, 0.5, 0.6], [0.9, 0.8, 0.7, 0.6, 0.5]];
    let cell = |u: f64| { let mut k = 0; while k < 3 && u > k as f64 - 1.0 { k += 1; } (k, u - k as f64 + 2.0) };
    let (i, s) = cell(x);
    let (j, t) = cell(y);
    let low = GRID[i][j] * (1.0 - t) + GRID[i][j + 1] * t;
    let high = GRID[i + 1][j] * (1.0 - t) + GRID[i + 1][j + 1] * t;
    z - (low * (1.0 - s) + high * s)
} }

// Knots that are not in order: the first one that holds is taken, wherever it stands.
twice! { Symbolic out_of_order(coord coord): fn f(x: Coord, y: Coord) -> f64 {
    const STEPS: [(f64, f64); 6] = [(-1.0, 0.5), (0.5, -0.7), (0.0, 0.3), (1.5, 0.9), (1.0, 0.1), (9.0, -0.4)];
    for (end, slope) in STEPS {
        if x < end {
            return y - slope * x.sin();
        }
    }
    y
} }

// Numbers of parameters in structs, with a branch in each piece.
twice! { Symbolic of_parameters(coord coord ([[0.5, 1.0], [0.25, -1.0], [-0.75, 2.0], [1.5, 0.0], [1.0, 0.5]])): fn f(x: Coord, y: Coord, pieces: [[f64; 2]; 5]) -> f64 {
    for (k, [offset, slope]) in pieces.into_iter().enumerate() {
        if x <= k as f64 - 1.5 || k == 4 {
            let s = slope * (x - offset);
            return y * (if s > 0.0 { s.cos() } else { 1.0 + s });
        }
    }
    y
} }

// A profile against the time, with two rows.
twice! { Symbolic against_time(coord coord time): fn f(x: Coord, y: Coord, t: Time) -> (f64, f64) {
    const TIMES: [f64; 6] = [-1.5, -0.5, 0.0, 0.5, 1.5, 3.0];
    const PLACES: [f64; 7] = [0.0, 0.5, 0.25, -0.5, -1.0, 1.0, 2.0];
    let k = TIMES.iter().take_while(|&&time| time <= t).count();
    let from = PLACES[k];
    let to = PLACES[(k + 1).min(6)];
    let s = (0.5 * t).sin();
    (x - (from + (to - from) * s), y * from - t)
} }
