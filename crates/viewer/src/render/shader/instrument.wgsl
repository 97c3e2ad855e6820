// A tool in a bright room: polished steel, or what insulates it.

struct Instrument {
    // From the tool's frame to the scene.
    placed: mat4x4f,
    // Its colour, with the polish in w: 1 for steel.
    color: vec4f,
    // The label in x.
    label: vec4f,
};

@group(1) @binding(0) var<uniform> instrument: Instrument;

struct Varyings {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(perspective, centroid) position: vec3f,
    @location(1) @interpolate(perspective, centroid) normal: vec3f,
};

@vertex
fn instrument_vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Varyings {
    let placed = instrument.placed * vec4f(position, 1.0);
    let turned = (instrument.placed * vec4f(normal, 0.0)).xyz;
    return Varyings(globals.view_projection * placed, placed.xyz, turned);
}

// How far ahead of the eye [m], and the label.
@fragment
fn instrument_label(in: Varyings) -> @location(0) vec4f {
    return vec4f(ahead(in.position), instrument.label.x, 0.0, 0.0);
}

@fragment
fn instrument_fragment(in: Varyings) -> @location(0) vec4f {
    let to_eye = normalize(globals.eye.xyz - in.position);
    let normal = normalize(in.normal);
    var towards = globals.key.xyz;
    var strength = 1.0;
    if (globals.key.w > 0.5) {
        let away = globals.key.xyz - in.position;
        strength = globals.key_color.w / dot(away, away);
        towards = normalize(away);
    }
    let reflected = 2.0 * dot(normal, to_eye) * normal - to_eye;
    let height = dot(reflected, globals.up.xyz);
    // A ceiling lamp, a horizon, a dark floor.
    let room = mix(0.03, 0.30, smoothstep(-0.30, 0.20, height))
        + 0.85 * smoothstep(0.50, 0.72, height) * (1.0 - 0.5 * smoothstep(0.80, 0.95, height));
    let half_way = clamp(dot(normal, normalize(towards + to_eye)), 0.0, 1.0);
    let glint = 2.2 * exp2(700.0 * (half_way - 1.0)) + 0.35 * exp2(40.0 * (half_way - 1.0));
    let facing = clamp(dot(normal, towards), 0.0, 1.0);
    let grazing = 1.0 - clamp(dot(normal, to_eye), 0.0, 1.0);
    let steel = instrument.color.rgb * (room * (0.8 + 0.9 * grazing * grazing * grazing) + 0.12 * facing);
    // Plastic shows its own colour and mirrors little of the room.
    let plastic = instrument.color.rgb * (0.35 + 1.1 * facing) + 0.05 * room * (1.0 + 4.0 * grazing * grazing);
    let polish = instrument.color.w;
    let shown = mix(plastic, steel, polish);
    let light = (shown * (0.35 + 0.65 * strength))
        + globals.key_color.rgb * glint * strength * mix(0.12, 0.6, polish);
    return framed(developed(light), in.clip.xy);
}
