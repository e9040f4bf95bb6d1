//! Removes the points of a line that do not change its picture.

use kin::{Vec2, vec2};

/// A point that a straight line misses by less than this share of the picture is left out: a tenth
/// of a pixel or so.
const INVISIBLE: f64 = 2e-4;

/// The points without those that nobody would miss (Douglas and Peucker), the picture taken as one
/// unit high and wide; all are finite.
pub fn thinned(points: &[Vec2]) -> Vec<Vec2> {
    let extent = |pick: fn(&Vec2) -> f64| {
        let (low, high) = points
            .iter()
            .map(pick)
            .fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        // Halves: the whole may be too large for a number.
        (0.5 * high - 0.5 * low).max(f64::MIN_POSITIVE)
    };
    let width = extent(|p| p.x);
    let height = extent(|p| p.y);
    let unit: Vec<Vec2> =
        points.iter().map(|p| vec2(0.5 * p.x / width, 0.5 * p.y / height)).collect();
    let visible = visible(&unit, INVISIBLE);
    visible.into_iter().map(|k| points[k]).collect()
}

/// The same with equal axes, where `invisible` is a length.
pub fn thinned_path(points: &[Vec2], invisible: f64) -> Vec<Vec2> {
    visible(points, invisible).into_iter().map(|k| points[k]).collect()
}

fn visible(points: &[Vec2], invisible: f64) -> Vec<usize> {
    let mut keep = vec![false; points.len()];
    let mut spans = vec![(0, points.len().saturating_sub(1))];
    while let Some((first, last)) = spans.pop().filter(|_| !points.is_empty()) {
        keep[first] = true;
        keep[last] = true;
        let miss = |k: usize| distance(points[k], points[first], points[last]);
        let worst = (first + 1..last).max_by(|&i, &j| miss(i).total_cmp(&miss(j)));
        if let Some(middle) = worst.filter(|&k| miss(k) > invisible) {
            spans.extend([(first, middle), (middle, last)]);
        }
    }
    (0..points.len()).filter(|&k| keep[k]).collect()
}

/// How far p is from the line between a and b.
fn distance(p: Vec2, a: Vec2, b: Vec2) -> f64 {
    let chord = b - a;
    let along = if chord.norm() > 0.0 {
        ((p - a).dot(chord) / chord.dot(chord)).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (p - a - chord * along).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_needs_its_ends_and_a_corner_itself() {
        let line: Vec<Vec2> = (0..100).map(|k| vec2(f64::from(k), 2.0 * f64::from(k))).collect();
        assert_eq!(thinned(&line).len(), 2);
        let corner: Vec<Vec2> =
            (-50..=50).map(|k| vec2(f64::from(k), f64::from(k).abs())).collect();
        assert_eq!(thinned(&corner), [vec2(-50.0, 50.0), vec2(0.0, 0.0), vec2(50.0, 50.0)]);
        assert!(thinned(&[]).is_empty());
        assert_eq!(thinned(&[vec2(1.0, 2.0)]).len(), 1);
    }

    #[test]
    fn a_circle_stays_within_the_tolerance() {
        let circle: Vec<Vec2> = (0..=2000)
            .map(|k| f64::from(k) / 2000.0 * std::f64::consts::TAU)
            .map(|x| vec2(x.cos(), x.sin()))
            .collect();
        let thin = thinned_path(&circle, 1e-3);
        assert!(thin.len() < 140, "{}", thin.len());
        for p in &circle {
            let nearest =
                thin.windows(2).map(|w| distance(*p, w[0], w[1])).fold(f64::MAX, f64::min);
            assert!(nearest < 1.01e-3);
        }
    }
}
