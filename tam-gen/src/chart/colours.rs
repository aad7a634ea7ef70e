//! Colours of groups of points.

/// Colours that the colour-blind tell apart on white (Okabe and Ito 2008), and a brown and a grey; sRGB. Groups beyond the
/// last begin anew.
pub const GROUP_COLOURS: [[u8; 3]; 9] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [138, 109, 0],
    [86, 180, 233],
    [122, 74, 30],
    [230, 159, 0],
    [102, 102, 102],
];
