//! Every composed source is valid WGSL.

use tam_shaders::{Capabilities, Pass, compose};

#[test]
fn every_composed_source_validates_with_and_without_primitive_index() {
    for pass in Pass::ALL {
        for primitive_index in [false, true] {
            let source = compose(pass, Capabilities { primitive_index });
            let module = naga::front::wgsl::parse_str(&source)
                .unwrap_or_else(|error| panic!("{}: {}", pass.name(), error.emit_to_string(&source)));
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::PRIMITIVE_INDEX,
            );
            validator
                .validate(&module)
                .unwrap_or_else(|error| panic!("{}: {}", pass.name(), error.emit_to_string(&source)));
        }
    }
}
