use kin::prelude::*;

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("slider");
    let slider = m.planar("slider", pose(0.0, 0.0, 0.0))?;
    m.add("motor", drive(slider, Law::ramp(1.0)))?;
    Ok(())
}
