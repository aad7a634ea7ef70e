// The edges that are lines, in order, and how many: a few in a hundred are, and only those are drawn. Blocks of edges are
// marked, their marks summed up, and each block lists its own behind those before it, so that the order is always the same.
//!include lib/scene.wgsl
//!include lib/mesh_types.wgsl
//!include lib/edges.wgsl

@group(2) @binding(1) var<storage, read_write> listed: array<u32>;
// Of each block, a bit for each edge that is a line.
@group(2) @binding(2) var<storage, read_write> marks: array<u32>;
// Of each block, the lines before it.
@group(2) @binding(3) var<storage, read_write> before: array<u32>;
// Of the draw: corners of a quad, quads, the first corner and the first quad.
@group(2) @binding(4) var<storage, read_write> arguments: array<u32, 4>;

const BLOCK_EDGES: u32 = 32u;
const BLOCK_LANES: u32 = 64u;
const SUMMING_LANES: u32 = 256u;

var<workgroup> sums: array<u32, SUMMING_LANES>;

fn is_line(edge: Edge) -> bool {
    return line_kind(edge, 0.5 * (end_world(edge.a) + end_world(edge.b))) != LINE_NONE;
}

@compute @workgroup_size(BLOCK_LANES)
fn mark(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let block = id.x + id.y * groups.x * BLOCK_LANES;
    if block >= arrayLength(&marks) {
        return;
    }
    let first = block * BLOCK_EDGES;
    var lines = 0u;
    for (var k = 0u; k < min(BLOCK_EDGES, arrayLength(&edges) - first); k++) {
        lines |= select(0u, 1u << k, is_line(edges[first + k]));
    }
    marks[block] = lines;
}

// One group: each lane sums up a run of blocks.
@compute @workgroup_size(SUMMING_LANES)
fn sum(@builtin(local_invocation_index) lane: u32) {
    let run = (arrayLength(&marks) + SUMMING_LANES - 1u) / SUMMING_LANES;
    let first = min(lane * run, arrayLength(&marks));
    let last = min(first + run, arrayLength(&marks));
    var own = 0u;
    for (var block = first; block < last; block++) {
        own += countOneBits(marks[block]);
    }
    sums[lane] = own;
    workgroupBarrier();
    var lines = 0u;
    for (var other = 0u; other < lane; other++) {
        lines += sums[other];
    }
    for (var block = first; block < last; block++) {
        before[block] = lines;
        lines += countOneBits(marks[block]);
    }
    if lane == SUMMING_LANES - 1u {
        arguments = array<u32, 4>(4u, lines, 0u, 0u);
    }
}

@compute @workgroup_size(BLOCK_LANES)
fn list(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let block = id.x + id.y * groups.x * BLOCK_LANES;
    if block >= arrayLength(&marks) {
        return;
    }
    var place = before[block];
    var lines = marks[block];
    while lines != 0u {
        listed[place] = block * BLOCK_EDGES + countTrailingZeros(lines);
        place += 1u;
        // Without its lowest bit.
        lines &= lines - 1u;
    }
}
