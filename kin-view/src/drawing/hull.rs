//! Computes outlines of bodies from the points at which constraints hold the bodies.

use kin::{Vec2, Vec3, vec2};

use crate::scene::circle;

/// How many corners a disc at a point has.
const CORNERS: usize = 16;

/// The convex hull of discs of that radius about the points, in the plane z = 0.
pub(crate) fn rounded(points: &[Vec3], radius: f64) -> Vec<Vec3> {
    let corners = points.iter().flat_map(|p| circle(vec2(p.x, p.y), radius, CORNERS)).collect();
    convex(corners).into_iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect()
}

/// The convex hull, counter-clockwise (monotone chain).
pub(crate) fn convex(mut points: Vec<Vec2>) -> Vec<Vec2> {
    points.retain(|p| p.x.is_finite() && p.y.is_finite());
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && turn(a, b, p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut points.iter().copied());
    lower.extend(half(&mut points.iter().rev().copied()));
    lower
}

/// Twice the area of the triangle a, b, c; positive if it turns left.
fn turn(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let u = b - a;
    let v = c - a;
    u.x * v.y - u.y * v.x
}

/// True if a polygon covers a point, both seen along z: a line to the right crosses its edge an odd
/// number of times.
pub(crate) fn covers(polygon: &[Vec3], p: Vec3) -> bool {
    let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crossed = edges.filter(|(a, b)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
    });
    crossed.count() % 2 == 1
}

/// In space: the corners of a plate if the points lie in a plane, else lines from their middle to
/// each.
pub(crate) enum Spread {
    Line(Vec<Vec3>),
    Plate(Vec<Vec3>),
    Star(Vec<[Vec3; 2]>),
}

pub(crate) fn spread(points: &[Vec3]) -> Spread {
    let (Some(first), true) = (points.first(), points.len() > 2) else {
        return Spread::Line(points.to_vec());
    };
    let far = |from: Vec3| {
        points
            .iter()
            .copied()
            .max_by(|a, b| (*a - from).norm().total_cmp(&(*b - from).norm()))
            .unwrap_or(from)
    };
    let a = far(*first);
    let x = far(a) - a;
    let off = |p: &Vec3| (*p - a) - x * ((*p - a).dot(x) / x.dot(x));
    let widest =
        points.iter().copied().max_by(|p, q| off(p).norm().total_cmp(&off(q).norm())).unwrap_or(a);
    let y = off(&widest);
    if y.norm() <= 1e-6 * x.norm() || !y.norm().is_finite() {
        return Spread::Line(vec![a, a + x]);
    }
    let x = x / x.norm();
    let y = y / y.norm();
    let normal = x.cross(y);
    if points.iter().any(|p| (*p - a).dot(normal).abs() > 1e-3 * (far(a) - a).norm()) {
        let middle =
            points.iter().fold(Vec3::new(0.0, 0.0, 0.0), |sum, p| sum + *p) / points.len() as f64;
        return Spread::Star(points.iter().map(|p| [middle, *p]).collect());
    }
    let flat = points.iter().map(|p| vec2((*p - a).dot(x), (*p - a).dot(y))).collect();
    Spread::Plate(convex(flat).into_iter().map(|p| a + x * p.x + y * p.y).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hull_of_a_square_leaves_out_what_is_inside() {
        let inside = (0..50).map(|k| vec2(0.01 * f64::from(k) + 0.2, 0.5));
        let corners = [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 1.0)];
        assert_eq!(convex(corners.into_iter().chain(inside).collect()), corners);
    }

    #[test]
    fn a_polygon_covers_what_is_inside() {
        let at = |x: f64, y: f64| Vec3::new(x, y, 0.0);
        let hook =
            [at(0.0, 0.0), at(3.0, 0.0), at(3.0, 1.0), at(1.0, 1.0), at(1.0, 3.0), at(0.0, 3.0)];
        assert!(covers(&hook, at(0.5, 2.0)) && covers(&hook, at(2.5, 0.5)));
        assert!(
            !covers(&hook, at(2.0, 2.0))
                && !covers(&hook, at(-0.1, 0.5))
                && !covers(&[], at(0.0, 0.0))
        );
    }

    #[test]
    fn two_points_make_a_bar_with_round_ends() {
        let bar = rounded(&[Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0)], 0.1);
        let most = |pick: fn(&Vec3) -> f64| bar.iter().map(pick).fold(f64::MIN, f64::max);
        assert!((most(|p| p.x) - 1.1).abs() < 1e-12 && (most(|p| p.y) - 0.1).abs() < 1e-12);
        assert!(bar.iter().all(|p| p.x.abs() >= 1.0 - 1e-12));
    }

    #[test]
    fn points_in_a_plane_of_space_make_a_plate() {
        let at = |x: f64, y: f64| Vec3::new(x, y, 2.0 * x - y + 1.0);
        let points = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0), at(0.5, 0.5)];
        let Spread::Plate(corners) = spread(&points) else { panic!("no plate") };
        assert_eq!(corners.len(), 4);
        assert!(corners.iter().all(|p| (p.z - 2.0 * p.x + p.y - 1.0).abs() < 1e-12));
        assert!(matches!(
            spread(&[at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), Vec3::new(0.0, 0.0, 5.0)]),
            Spread::Star(_)
        ));
        assert!(matches!(spread(&[at(0.0, 0.0), at(1.0, 1.0), at(2.0, 2.0)]), Spread::Line(_)));
    }
}
