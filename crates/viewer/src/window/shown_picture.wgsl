// A finished picture on its place in the window, pixel by pixel, or smoothly where it has fewer.

// 1 where the picture has another number of pixels than its place.
override FILTERED: u32 = 0u;
// 1 where the window takes linear light and bends it to the display's gamma itself.
override LINEAR: u32 = 0u;

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;

struct Varyings {
    @builtin(position) clip: vec4f,
    @location(0) at: vec2f,
};

@vertex
fn shown_vertex(@builtin(vertex_index) index: u32) -> Varyings {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return Varyings(vec4f(corner.x * 2.0 - 1.0, 1.0 - corner.y * 2.0, 0.0, 1.0), corner);
}

@fragment
fn shown_fragment(in: Varyings) -> @location(0) vec4f {
    var color = vec4f(0.0);
    if (FILTERED == 1u) {
        color = textureSampleLevel(picture, picture_sampler, in.at, 0.0);
    } else {
        color = textureLoad(picture, vec2i(in.at * vec2f(textureDimensions(picture))), 0);
    }
    if (LINEAR == 1u) {
        let low = color.rgb / 12.92;
        let high = pow((color.rgb + 0.055) / 1.055, vec3f(2.4));
        return vec4f(select(high, low, color.rgb <= vec3f(0.04045)), 1.0);
    }
    return vec4f(color.rgb, 1.0);
}
