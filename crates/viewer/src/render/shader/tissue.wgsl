// An organ: tissue under a wet film.

// How the organ is drawn: 0 plain, 1 texture, 2 sphere map, 3 cube map.
override SHADING: u32 = 0u;
// 1 with the tissue map: relief, and colours where the shading has any.
override RELIEF: u32 = 1u;
// 1 where light goes round the edges of shadows and relief, red farthest.
override SCATTERING: u32 = 1u;
// How many tools cast shadows.
override SHADOWS: u32 = 2u;
// 1 where the light is an endoscope's.
override ENDOSCOPE: u32 = 0u;
// 1 on cut muscle.
override FIBRES: u32 = 0u;

// An opening around a straight part of a cut: its ends [m], with the half width there in w [m].
struct Opening {
    start: vec4f,
    end: vec4f,
};

struct Body {
    // Dark and light tissue, and vessels.
    dark: vec4f,
    light: vec4f,
    vessel: vec4f,
    // Periods of the tissue map [1/m], steepness of the relief, part of the environment map that is taken
    // as the tissue's own colour, strength of the film.
    detail: vec4f,
    // Where muscle is cut through: the axis that its outer fibres run along, and a point of it [m].
    fibres: vec4f,
    // With w: 0 by depth, 1 along the axis, 2 around it.
    fibre_center: vec4f,
    // How many openings there are in x, the label in y.
    opened: vec4f,
    openings: array<Opening, 128>,
};

@group(1) @binding(0) var tissue_map: texture_3d<f32>;
@group(1) @binding(1) var tissue_sampler: sampler;
@group(1) @binding(2) var sphere_map: texture_2d<f32>;
@group(1) @binding(3) var cube_map: texture_cube<f32>;
@group(1) @binding(4) var map_sampler: sampler;
@group(2) @binding(0) var<uniform> body: Body;

struct Varyings {
    @builtin(position) clip: vec4f,
    // Inside of the triangle also where a pixel's middle is not: edges would glitter.
    @location(0) @interpolate(perspective, centroid) position: vec3f,
    @location(1) @interpolate(perspective, centroid) normal: vec3f,
    // Where the point is at rest, and how open it is to light from all sides.
    @location(2) @interpolate(perspective, centroid) rest: vec4f,
};

@vertex
fn tissue_vertex(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) rest: vec4f,
) -> Varyings {
    return Varyings(globals.view_projection * vec4f(position, 1.0), position, normal, rest);
}

// Maps keep the square root of the light over four.
fn decoded(texel: vec4f) -> vec3f {
    return 4.0 * texel.rgb * texel.rgb;
}

// What the film mirrors in the direction `reflected`: through the half of the sphere that the eye sees,
// as graphics hardware counts it, or through six sides.
fn mirrored(reflected: vec3f) -> vec3f {
    if (SHADING == 2u) {
        let r = (globals.to_eye * vec4f(reflected, 0.0)).xyz;
        let m = 2.0 * sqrt(max(r.x * r.x + r.y * r.y + (r.z + 1.0) * (r.z + 1.0), 1e-6));
        let at = vec2f(r.x / m + 0.5, 0.5 - r.y / m);
        return decoded(textureSampleLevel(sphere_map, map_sampler, at, 0.0));
    }
    // Sides are left-handed, and up is +z in a scene.
    let side = vec3f(reflected.x, reflected.z, reflected.y);
    return decoded(textureSampleLevel(cube_map, map_sampler, side, 0.0));
}

// Light from all sides that a capsule leaves over.
fn left_by(tool: Capsule, position: vec3f, normal: vec3f) -> f32 {
    let along = tool.end.xyz - tool.start.xyz;
    let offset = position - tool.start.xyz;
    let part = clamp(dot(offset, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
    let away = offset - part * along;
    let distance = max(length(away), tool.start.w);
    let ratio = tool.start.w / distance;
    return 1.0 - max(dot(-away, normal), 0.0) / distance * ratio;
}

// A normal under a relief of this slope.
fn bent(normal: vec3f, slope: vec3f) -> vec3f {
    return normalize(normal - slope + normal * dot(slope, normal));
}

// What a capsule leaves of light that comes from the direction `towards`: its soft shadow, by how near the
// way to the light passes.
fn lit_beside(tool: Capsule, position: vec3f, towards: vec3f) -> f32 {
    let along = tool.end.xyz - tool.start.xyz;
    let offset = position - tool.start.xyz;
    let squared = max(dot(along, along), 1e-12);
    let slant = dot(along, towards);
    let ahead = dot(offset, towards);
    let beside = dot(offset, along);
    let apart = max(squared - slant * slant, 1e-4 * squared);
    let part = clamp((beside - ahead * slant) / apart, 0.0, 1.0);
    let way = max(part * slant - ahead, 0.0);
    let nearest = offset + way * towards - part * along;
    let blur = 0.6 * tool.start.w + 0.16 * way;
    let lit = smoothstep(-blur, blur, length(nearest) - tool.start.w);
    return mix(1.0, lit, smoothstep(0.0, 0.3 * tool.start.w, way));
}

fn mark(place: vec4f, rest: vec3f) -> f32 {
    if (place.w <= 0.0) {
        return 0.0;
    }
    let distance = length(rest - place.xyz) / place.w;
    return exp(-130.0 * (distance - 1.0) * (distance - 1.0));
}

// Where the tissue map is looked up: at the place at rest, on cut muscle drawn out along the fibres, which
// run along the axis in the outer half of the wall and around it in the inner one.
fn looked_up(rest: vec4f) -> vec3f {
    if (FIBRES == 0u) {
        return rest.xyz * body.detail.x;
    }
    let axis = body.fibres.xyz;
    let out = rest.xyz - body.fibre_center.xyz;
    let around = normalize(cross(axis, out - dot(out, axis) * axis) + vec3f(1e-9, 0.0, 0.0));
    let by_depth = rest.w > 0.68;
    let is_along = select(by_depth, (body.fibre_center.w < 1.5), (body.fibre_center.w > 0.5));
    let run = select(around, axis, is_along);
    let drawn = rest.xyz - 0.94 * dot(out, run) * run;
    // A wall's rows differ in depth alone, which its openness tells.
    return (drawn * 1.7 + (1.0 - rest.w) * 0.011 * vec3f(0.61, 0.53, 0.59)) * body.detail.x;
}

// Width of the cut face around an opening [m].
const FACE: f32 = 0.0003;

// How far a place at rest is outside of the openings of this layer [m].
fn outside(rest: vec3f) -> f32 {
    var nearest = 1.0;
    for (var k = 0u; k < u32(body.opened.x); k++) {
        let opening = body.openings[k];
        let along = opening.end.xyz - opening.start.xyz;
        let offset = rest - opening.start.xyz;
        let part = clamp(dot(offset, along) / max(dot(along, along), 1e-14), 0.0, 1.0);
        let half_width = mix(opening.start.w, opening.end.w, part);
        nearest = min(nearest, length(offset - part * along) - half_width);
    }
    return nearest;
}

// How far ahead of the eye [m], and the label.
@fragment
fn tissue_label(in: Varyings) -> @location(0) vec4f {
    if (outside(in.rest.xyz) < 0.0) {
        discard;
    }
    return vec4f(ahead(in.position), body.opened.y, 0.0, 0.0);
}

@fragment
fn tissue_fragment(in: Varyings) -> @location(0) vec4f {
    let to_eye = normalize(globals.eye.xyz - in.position);
    let smooth_normal = normalize(in.normal);
    let beside = outside(in.rest.xyz);
    if (beside < 0.0) {
        discard;
    }
    var normal = smooth_normal;
    var tone = 0.62;
    var relief = vec3f(0.0);
    if (RELIEF == 1u) {
        let texel = textureSampleLevel(
            tissue_map, tissue_sampler, looked_up(in.rest), globals.levels.x,
        );
        relief = (texel.rgb - 0.5) * body.detail.y;
        normal = bent(smooth_normal, relief);
        if (SHADING != 0u) {
            tone = texel.a;
        }
    }
    let own = mix(body.dark.rgb, body.light.rgb, clamp((tone - 0.3) / 0.7, 0.0, 1.0));
    var color = mix(body.vessel.rgb, own, smoothstep(0.0, 0.3, tone));
    // The cut face of a layer, darker towards what lies below.
    let face = 1.0 - smoothstep(0.7 * FACE, FACE, beside);
    color = mix(color, body.dark.rgb * mix(0.25, 0.8, clamp(beside / FACE, 0.0, 1.0)), face);

    var towards = globals.key.xyz;
    var strength = 1.0;
    if (ENDOSCOPE == 1u) {
        let away = globals.key.xyz - in.position;
        towards = normalize(away);
        // An endoscope's light falls with the distance and towards the edge of its cone; its back is up.
        let inside = clamp(dot(towards, globals.up.xyz), 0.0, 1.0);
        strength = fallen(dot(away, away), globals.key_color.w) * inside * inside;
    }
    var open = in.rest.w;
    var lit = 1.0;
    if (SHADOWS >= 1u) {
        open *= left_by(globals.tools[0], in.position, normal);
        lit = lit_beside(globals.tools[0], in.position, towards);
    }
    if (SHADOWS >= 2u) {
        open *= left_by(globals.tools[1], in.position, normal);
        lit *= lit_beside(globals.tools[1], in.position, towards);
    }
    let around = mix(globals.ground.rgb, globals.sky.rgb, 0.5 + 0.5 * dot(normal, globals.up.xyz));
    let direct = globals.key_color.rgb * strength * mix(0.35, 1.0, open);
    var arriving = direct * lit * clamp(dot(normal, towards), 0.0, 1.0);
    if (SCATTERING == 1u) {
        // Light enters tissue and comes out beside: red sees the smoothest surface, and its shadows are the softest.
        let rough = dot(normal, towards);
        let even = dot(smooth_normal, towards);
        let facing = mix(vec3f(even), vec3f(rough), vec3f(0.25, 0.65, 0.80));
        let through = mix(vec3f(0.20, 0.12, 0.11), vec3f(1.0), vec3f(sqrt(lit), lit, lit));
        arriving = scattered(facing, WRAP) * direct * through;
    }
    arriving += around * open;

    var shine = vec3f(0.0);
    if (SHADING >= 2u && body.detail.w > 0.0) {
        // Liquid fills the relief, more of it in hollows of the tone; where it is thin the film is rough.
        let pool = smoothstep(0.35, 0.85, tone);
        let film_normal = bent(smooth_normal, relief * mix(1.0, 0.45, pool));
        let roughness = mix(0.40, 0.20, pool);
        let reflectance = fresnel(dot(film_normal, to_eye));
        let reflection = mirrored(2.0 * dot(film_normal, to_eye) * film_normal - to_eye);
        color = wetted(mix(color, 0.55 * reflection, body.detail.z)) * leaving(reflectance);
        shine = reflection * open * (0.4 + 0.6 * min(strength, 1.0)) * reflectance;
        shine += direct * lit * glitter(film_normal, towards, to_eye, roughness);
        if (ENDOSCOPE == 0u) {
            // A lamp beside the eye, which a film shows before it lights the tissue.
            let beside_eye = normalize(to_eye - 0.25 * globals.up.xyz);
            shine += 3.0 * globals.sky.rgb * open * glitter(film_normal, beside_eye, to_eye, roughness);
        }
    } else {
        let middle = clamp(dot(normal, normalize(towards + to_eye)), 0.0, 1.0);
        shine = direct * lit * 0.06 * exp2(30.0 * (middle - 1.0)) * body.detail.w;
    }
    let ring = mark(globals.marks[0], in.rest.xyz) + mark(globals.marks[1], in.rest.xyz);
    let light = mix(color * arriving + shine, vec3f(0.10, 0.62, 0.54), min(0.75 * ring, 1.0));
    return framed(developed(light), in.clip.xy);
}
