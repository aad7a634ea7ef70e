// Which form of a method is drawn. Each is a constant of the pipeline, so a frame pays for one of them only.

const FORM_HARDENED: u32 = 0u;
// As the source prints it, with its failures.
const FORM_LITERAL: u32 = 1u;
override FORM: u32 = 0u;
