//! Types that a parameter of a constraint can have. (Messages of rustc show these lines: a file of
//! their own keeps them where they are.)

/// A parameter of a constraint: any value of its own.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be a parameter of a constraint",
    label = "not a parameter",
    note = "give an owned parameter that is `Clone + Send + Sync`; Kin reads types by name, so write `Planar`, `Spatial`, `Coord` or `Time` and no alias of these types"
)]
pub trait Parameter: Clone + Send + Sync + 'static {}

impl<T: Clone + Send + Sync + 'static> Parameter for T {}

/// Compiles for parameters only.
pub const fn is_parameter<T: Parameter>() -> bool {
    true
}

/// A type that is called as one of Kin's is.
pub struct Named<T>(std::marker::PhantomData<T>);

/// The default for any type of the user's.
pub trait Own {
    /// It is no handle of a body.
    const IS_OWN: bool = true;
}

impl<T> Own for Named<T> {}

impl Named<crate::coordinates::Link> {
    /// It is a handle.
    pub const IS_OWN: bool = false;
}

impl Named<crate::coordinates::SpatialLink> {
    /// It is a handle.
    pub const IS_OWN: bool = false;
}

/// Stops the compiler with a text where something does not hold.
pub const fn held(holds: bool, text: &str) {
    if !holds {
        panic!("{}", text);
    }
}
