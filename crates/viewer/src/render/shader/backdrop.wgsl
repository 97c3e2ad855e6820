// The background: one triangle over the whole picture, lighter in the middle.

@vertex
fn backdrop_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4f(corner * 2.0 - 1.0, 1.0, 1.0);
}

@fragment
fn backdrop_fragment(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let size = globals.picture.xy;
    let centred = (pixel.xy - vec2f(0.5, 0.46) * size) / size.y;
    // Already bent to the display's gamma.
    let middle = 1.0 / (1.0 + 3.2 * dot(centred, centred));
    return framed(mix(globals.backdrop_edge.rgb, globals.backdrop.rgb, middle * middle), pixel.xy);
}
