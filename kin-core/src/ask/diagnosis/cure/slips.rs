//! Finds mistakes with points: points in the wrong order, in the wrong frame or at the wrong end.
//!
//! Kin tests a mistake only if the numbers suggest the mistake. Kin reports a mistake only if the
//! mechanism closes and moves without it.

use super::super::search_under_way::Search;
use super::dimension::{self, PointAt};
use super::trial::{Trial, drivers};
use crate::coordinates::layout::Kind;
use crate::model::state::{PlanarState, SpatialState};
use crate::numbers::algebra::{Vec2, Vec3};
use crate::outcome::verdict::{Change, GlobalPoint};
use crate::solve::assembly::search;
use crate::system::evaluate::Equations;
use crate::system::scaled::Model;

/// Points nearer than this share of the mechanism's length coincide. \[-\]
const SAME: f64 = 1e-6;

/// A mistake and the constraint that contains it.
pub(crate) struct Slip {
    pub change: Change,
    pub block: usize,
}

/// Returns the first mistake without which everything closes and moves.
pub(crate) fn find(search: &Search<'_>, drawn: &[f64], length: f64) -> Option<Slip> {
    let looked = Looked { search, drawn, length, points: dimension::points(&search.model) };
    looked.global_points().or_else(|| looked.swapped()).or_else(|| looked.same_end())
}

struct Looked<'a> {
    search: &'a Search<'a>,
    drawn: &'a [f64],
    length: f64,
    points: Vec<PointAt>,
}

impl Looked<'_> {
    fn model(&self) -> &Model<'_> {
        &self.search.model
    }

    /// Returns true if the mechanism with other numbers closes and moves.
    fn works(&self, change: impl FnOnce(&mut Equations) -> bool) -> bool {
        /// The number of starts: the guess and a few around it.
        const STARTS: usize = 6;
        let mut equations = self.model().equations.clone();
        if !change(&mut equations) {
            return false;
        }
        let model = Model { equations: &equations, ..*self.model() };
        let options = self.search.options.clone().starts(STARTS);
        let found = search::search(model, self.drawn, self.search.t, &|_| true, &options)
            .filter(|found| found.met && found.meant);
        let trial = Trial { model, t: self.search.t, without: &[], steps: options.steps };
        found.is_some_and(|found| trial.moves(&found, &drivers(&model, &[])))
    }

    /// Returns the global position of a point of a body as it is drawn, or `None` if nobody gave
    /// the pose of the body.
    fn global(&self, point: &PointAt, u: &[f64]) -> Option<[f64; 3]> {
        let Some(item) = point.item else { return Some(vector(u)) };
        let item = &self.model().layout.items[item];
        let q = &self.drawn[item.first..];
        match item.kind {
            Kind::Planar if q[..3] != [0.0; 3] => {
                let p = PlanarState::new(*q.first_chunk()?).point(Vec2::new(u[0], u[1]));
                Some([p.x, p.y, 0.0])
            }
            Kind::Spatial if q[..3] != [0.0; 3] => {
                let [x, y, z] = vector(u);
                let p = SpatialState::new(*q.first_chunk()?).point(Vec3::new(x, y, z));
                Some([p.x, p.y, p.z])
            }
            _ => None,
        }
    }

    /// Returns the local position in a body of a global point, for the body as it is drawn.
    fn local(&self, item: usize, p: &[f64]) -> Option<Vec<f64>> {
        let item = &self.model().layout.items[item];
        let q = &self.drawn[item.first..];
        match item.kind {
            Kind::Planar => {
                let u = PlanarState::new(*q.first_chunk()?).local(Vec2::new(p[0], p[1]));
                Some(vec![u.x, u.y])
            }
            Kind::Spatial => {
                let [x, y, z] = vector(p);
                let u = SpatialState::new(*q.first_chunk()?).local(Vec3::new(x, y, z));
                Some(vec![u.x, u.y, u.z])
            }
            _ => None,
        }
    }

    fn apart(&self, a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt() > SAME * self.length
    }

    /// Returns the constraints with exactly two points, in different bodies. Usually these points
    /// meet.
    fn pairs(&self) -> impl Iterator<Item = (&PointAt, &PointAt)> {
        self.points.chunk_by(|a, b| a.block == b.block).filter_map(|own| match own {
            [i, j] if i.argument != j.argument && i.value.len() == j.value.len() => Some((i, j)),
            _ => None,
        })
    }

    /// Looks for points that would meet, as bodies are drawn, if they were global points.
    fn global_points(&self) -> Option<Slip> {
        let mut wrong: Vec<(&PointAt, Vec<f64>)> = Vec::new();
        for (i, j) in self.pairs() {
            let as_given = |point: &PointAt| self.global(point, &point.value);
            if let (Some(a), Some(b)) = (as_given(i), as_given(j))
                && !self.apart(a, b)
            {
                continue;
            }
            // One of the points, or both, can be in global coordinates.
            let p = vector(&i.value);
            let q = vector(&j.value);
            let meets = |known: Option<[f64; 3]>, global: [f64; 3]| {
                known.is_some_and(|known| !self.apart(known, global))
            };
            let slipped: &[&PointAt] = match (i.item, j.item) {
                _ if !self.apart(p, q) && i.value.iter().any(|x| *x != 0.0) => &[i, j],
                (_, Some(_)) if meets(as_given(i), q) => &[j],
                (Some(_), _) if meets(as_given(j), p) => &[i],
                _ => &[],
            };
            for point in slipped {
                let drawn = point.item.filter(|_| self.global(point, &point.value).is_some());
                wrong
                    .extend(drawn.and_then(|item| Some((*point, self.local(item, &point.value)?))));
            }
        }
        let block = wrong.first()?.0.block;
        let works = self.works(|equations| {
            wrong.iter().all(|(point, local)| {
                local
                    .iter()
                    .enumerate()
                    .all(|(k, x)| dimension::set(equations, (point.block, point.first + k), *x))
            })
        });
        let told = |(point, local): &(&PointAt, Vec<f64>)| GlobalPoint {
            constraint: self.model().equations.blocks[point.block].name.clone(),
            point: point.name.clone(),
            body: self.name(point.item),
            given: point.value.clone(),
            local: local.clone(),
        };
        works.then_some(Slip {
            change: Change::Local { points: wrong.iter().map(told).collect() },
            block,
        })
    }

    fn name(&self, item: Option<usize>) -> String {
        item.map_or_else(
            || "ground".to_string(),
            |item| self.model().layout.items[item].name.clone(),
        )
    }

    /// Returns true if another constraint holds a body at the mirror image of this point: then both
    /// are the ends of a link.
    fn is_end(&self, u: &[f64], item: Option<usize>, block: usize) -> bool {
        let mirrored = |point: &&PointAt| {
            point.block != block && point.value.iter().zip(u).all(|(a, b)| *a == -b)
        };
        item.is_some()
            && u.iter().any(|x| *x != 0.0)
            && self.points.iter().filter(|point| point.item == item).any(|point| mirrored(&point))
    }

    /// Looks for two points that belong to each other's body.
    fn swapped(&self) -> Option<Slip> {
        let told = |(i, j): (&PointAt, &PointAt)| {
            let ends = self.is_end(&j.value, i.item, i.block)
                && (j.item.is_none() || self.is_end(&i.value, j.item, i.block))
                || i.item.is_none()
                    && self.is_end(&i.value, j.item, i.block)
                    && !self.is_end(&j.value, j.item, i.block);
            // For a link and a body of another shape: the end of the link is the point of that
            // body, and a point that is no end is the point of the link.
            let foreign_end = |own: &PointAt, other: &PointAt| {
                self.is_end(&other.value, own.item, i.block) && other.item.is_some()
            };
            let link = foreign_end(i, j) || foreign_end(j, i);
            let [i_is_right, j_is_right] =
                [i, j].map(|point| self.is_end(&point.value, point.item, i.block));
            let one_is_right = i_is_right && j_is_right;
            let drawn = |a: &PointAt, u: &PointAt| self.global(a, &u.value);
            let meet = |a: Option<[f64; 3]>, b: Option<[f64; 3]>| matches!((a, b), (Some(a), Some(b)) if !self.apart(a, b));
            let as_drawn = meet(drawn(i, j), drawn(j, i)) && !meet(drawn(i, i), drawn(j, j));
            let likely = ends && !one_is_right || link && !i_is_right && !j_is_right || as_drawn;
            if !likely || i.value == j.value {
                return None;
            }
            let works = self.works(|equations| {
                let mut put = |at: &PointAt, from: &PointAt| {
                    let mut all = from.value.iter().enumerate();
                    all.all(|(k, x)| dimension::set(equations, (at.block, at.first + k), *x))
                };
                put(i, j) && put(j, i)
            });
            let constraint = self.model().equations.blocks[i.block].name.clone();
            let bodies = [self.name(i.item), self.name(j.item)];
            let points = [i.value.clone(), j.value.clone()];
            works.then_some(Slip {
                change: Change::Swap { constraint, bodies, points },
                block: i.block,
            })
        };
        self.pairs().find_map(told)
    }

    /// Looks for two constraints at the same end of a body that has no constraint at its other end.
    fn same_end(&self) -> Option<Slip> {
        for (k, a) in self.points.iter().enumerate() {
            let on_body: Vec<&PointAt> = self
                .points
                .iter()
                .filter(|point| point.item.is_some() && point.item == a.item)
                .collect();
            let [first, second] = on_body[..] else { continue };
            let is_end = a.value[0] != 0.0 && a.value[1..].iter().all(|x| *x == 0.0);
            if first.value != second.value
                || !is_end
                || first.block == second.block
                || !std::ptr::eq(first, &raw const self.points[k])
            {
                continue;
            }
            let works = [first, second].into_iter().any(|point| {
                self.works(|equations| {
                    let mut all = point.value.iter().enumerate();
                    all.all(|(k, x)| dimension::set(equations, (point.block, point.first + k), -x))
                })
            });
            if works {
                let constraints = [first, second]
                    .map(|point| self.model().equations.blocks[point.block].name.clone());
                let change = Change::OtherEnd {
                    constraints,
                    body: self.name(a.item),
                    point: a.value.clone(),
                };
                return Some(Slip { change, block: second.block });
            }
        }
        None
    }
}

fn vector(u: &[f64]) -> [f64; 3] {
    [0, 1, 2].map(|k| u.get(k).copied().unwrap_or_default())
}
