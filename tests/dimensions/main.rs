//! Named dimensions: numbers that others hang on.

mod axes;
#[path = "../data/engines.rs"]
mod engines;
mod files;
mod loads;
mod meant;
mod mistakes;
mod names;
mod poses;
mod proved;
mod samples;
mod set;
mod slopes;
mod tolerance;
mod worst;

use kin::prelude::*;

/// A slider-crank whose lengths, offset, driver and guess hang on dimensions.
pub struct SliderCrank {
    pub crank: f64,
    pub rod: f64,
    pub offset: f64,
    pub speed: f64,
}

pub const NOMINAL: SliderCrank = SliderCrank { crank: 0.1, rod: 0.3, offset: 0.02, speed: 2.0 };

impl SliderCrank {
    /// Built with these numbers; with dimensions the rod's length is `ratio · crank`, and the
    /// slider's guess hangs on both.
    pub fn described(&self) -> kin::Result<Mechanism> {
        let mut m = Mechanism::new("slider-crank");
        let a = m.dimension("crank", self.crank)?.unit("m").within(0.05, 0.2).tolerance(1e-4);
        let ratio = m.dimension("ratio", self.rod / self.crank)?;
        let offset = m.dimension("offset", self.offset)?;
        let speed = m.dimension("speed", self.speed)?;
        let crank = m.link("crank", a)?;
        let rod = m.link("rod", ratio * a)?;
        let slider = m.planar("slider", pose(a + ratio * a, offset, 0.0))?;
        m.add("O", revolute(crank, Ground, crank.start(), vec2(0.0, 0.0)))?;
        m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
        m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0)))?;
        m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, offset), (0.0, 1.0), 0.0))?;
        m.add(
            "motor",
            drive_angle(crank, Law::linear(0.3, speed) + Law::sine(0.1 * speed, 1.0, 0.0)),
        )?;
        Ok(m)
    }

    /// The same without dimensions.
    pub fn plain(&self) -> kin::Result<Mechanism> {
        let mut m = Mechanism::new("slider-crank");
        let crank = m.link("crank", self.crank)?;
        let rod = m.link("rod", self.rod)?;
        let slider = m.planar("slider", pose(self.crank + self.rod, self.offset, 0.0))?;
        m.add("O", revolute(crank, Ground, crank.start(), vec2(0.0, 0.0)))?;
        m.add("A", revolute(crank, rod, crank.end(), rod.start()))?;
        m.add("B", revolute(rod, slider, rod.end(), (0.0, 0.0)))?;
        m.add("guide", prismatic(slider, Ground, (0.0, 0.0), (0.0, self.offset), (0.0, 1.0), 0.0))?;
        let law = Law::linear(0.3, self.speed) + Law::sine(0.1 * self.speed, 1.0, 0.0);
        m.add("motor", drive_angle(crank, law))?;
        Ok(m)
    }
}

pub fn times() -> Vec<f64> {
    linspace(0.0, 3.0, 31)
}

/// The largest difference of q, q̇ and q̈ of two motions, relative to 1 + the number.
pub fn apart(a: &Motion, b: &Motion) -> f64 {
    assert_eq!((a.len(), a.names()), (b.len(), b.names()));
    let all = |m: &Motion| -> Vec<f64> {
        (0..m.len()).flat_map(|k| [m.q(k), m.qd(k), m.qdd(k)].concat()).collect()
    };
    let differences = all(a).into_iter().zip(all(b)).map(|(a, b)| (a - b).abs() / (1.0 + b.abs()));
    differences.fold(0.0, f64::max)
}

/// True if two motions have the same bits.
pub fn same_bits(a: &Motion, b: &Motion) -> bool {
    let bits = |m: &Motion| -> Vec<u64> {
        (0..m.len()).flat_map(|k| [m.q(k), m.qd(k), m.qdd(k)].concat()).map(f64::to_bits).collect()
    };
    bits(a) == bits(b)
}
