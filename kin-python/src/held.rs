//! Answers that borrow the system and the motion that they are of: each is kept together with
//! these, so that it is found once and Python may keep it as long as it likes.

use std::sync::Arc;

use kin::design::Sensitivities;
use kin::forces::Forces;
use self_cell::self_cell;

/// A system, and a motion of it.
pub type Run = (Arc<kin::System>, Arc<kin::Motion>);

self_cell!(
    /// The forces of a motion.
    pub struct HeldForces {
        owner: Run,
        #[covariant]
        dependent: Forces,
    }
);

self_cell!(
    /// The derivatives of a motion by parameters.
    pub struct HeldSensitivities {
        owner: Run,
        #[covariant]
        dependent: Sensitivities,
    }
);
