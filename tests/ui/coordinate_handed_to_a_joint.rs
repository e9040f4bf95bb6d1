use kin::prelude::*;

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0)?;
    m.add("motor", drive_angle(crank.theta(), Law::ramp(1.0)))?;
    Ok(())
}
