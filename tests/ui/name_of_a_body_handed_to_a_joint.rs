use kin::prelude::*;

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("crank");
    let crank = m.link("crank", 1.0)?;
    m.add("O", revolute("ground", crank, vec2(0.0, 0.0), crank.start()))?;
    Ok(())
}
