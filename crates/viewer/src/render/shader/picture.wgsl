// What every shader of the picture shares: the uniforms of a picture, and how light becomes a pixel.

struct Capsule {
    // From xyz [m], with the radius [m] in w.
    start: vec4f,
    // To xyz [m].
    end: vec4f,
};

struct Globals {
    view_projection: mat4x4f,
    // Rotation from the scene to the eye's frame, for sphere maps.
    to_eye: mat4x4f,
    // xyz [m]; w is 1 for an endoscope.
    eye: vec4f,
    // Direction towards the key light, or with w = 1 the place of the lamp [m].
    key: vec4f,
    // Its colour; w is the squared distance at which a lamp gives that light [m²].
    key_color: vec4f,
    // Direction that is up for the light from all sides.
    up: vec4f,
    sky: vec4f,
    ground: vec4f,
    // Centre and edge of the background.
    backdrop: vec4f,
    backdrop_edge: vec4f,
    // Width and height [pixels], exposure, strength of the vignette.
    picture: vec4f,
    // Level of the tissue map, which follows from the distance.
    levels: vec4f,
    tools: array<Capsule, 2>,
    // Touched places of the organ at rest, xyz [m], with the radius of the mark [m] in w.
    marks: array<vec4f, 2>,
};

@group(0) @binding(0) var<uniform> globals: Globals;

// How far ahead of the eye a point is, along the line of sight to the middle of the picture [m].
fn ahead(position: vec3f) -> f32 {
    return -(globals.to_eye * vec4f(position - globals.eye.xyz, 0.0)).z;
}

// Filmic curve [Narkowicz 2016], then the display's gamma.
fn developed(light: vec3f) -> vec3f {
    let x = light * globals.picture.z;
    let curve = (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
    return pow(clamp(curve, vec3f(0.0), vec3f(1.0)), vec3f(1.0 / 2.2));
}

// Darker towards the corners; an endoscope shows a disc.
fn framed(color: vec3f, pixel: vec2f) -> vec4f {
    let centred = (pixel - 0.5 * globals.picture.xy) / (0.5 * globals.picture.y);
    let squared = dot(centred, centred);
    var light = 1.0 / (1.0 + globals.picture.w * squared);
    if (globals.eye.w > 0.5) {
        let edge = 1.16;
        light *= 1.0 - smoothstep(edge - 0.03, edge + 0.01, sqrt(squared));
    }
    return vec4f(color * light, 1.0);
}
