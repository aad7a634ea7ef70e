//! Twin of `lib/form.wgsl`: which form of a method is drawn is [`Options::form`](crate::cpu::Options::form).

pub use crate::cpu::options::Form;
