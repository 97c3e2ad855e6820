// An organ: tissue under a wet film.

// How the organ is drawn: 0 plain, 1 texture, 2 sphere map, 3 cube map.
override SHADING: u32 = 0u;
// 1 with the tissue map: relief, and colours where the shading has any.
override DETAIL: u32 = 1u;

struct Body {
    // Dark and light tissue, and vessels.
    dark: vec4f,
    light: vec4f,
    vessel: vec4f,
    // Periods of the tissue map [1/m], steepness of the relief, part of the environment map that is taken
    // as the tissue's own colour, strength of the film.
    detail: vec4f,
    // Where muscle is cut through: the axis that its outer fibres run along, with w = 1, and a point of it [m].
    fibres: vec4f,
    fibre_center: vec4f,
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
    let left = 1.0 - max(dot(-away, normal), 0.0) / distance * ratio;
    return mix(1.0, left, tool.end.w);
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
    return mix(1.0, lit, tool.end.w * smoothstep(0.0, 0.3 * tool.start.w, way));
}

fn mark(place: vec4f, rest: vec3f) -> f32 {
    let distance = length(rest - place.xyz) / max(place.w, 1e-6);
    let ring = exp(-130.0 * (distance - 1.0) * (distance - 1.0));
    return select(0.0, ring, place.w > 0.0);
}

// Where the tissue map is looked up: at the place at rest, on cut muscle drawn out along the fibres, which
// run along the axis in the outer half of the wall and around it in the inner one.
fn looked_up(rest: vec4f) -> vec3f {
    let axis = body.fibres.xyz;
    let out = rest.xyz - body.fibre_center.xyz;
    let around = normalize(cross(axis, out - dot(out, axis) * axis) + vec3f(1e-9, 0.0, 0.0));
    let run = select(around, axis, rest.w > 0.68);
    let drawn = rest.xyz - 0.94 * dot(out, run) * run;
    // A wall's rows differ in depth alone, which its openness tells.
    let stacked = drawn * 1.7 + (1.0 - rest.w) * 0.011 * vec3f(0.61, 0.53, 0.59);
    return mix(rest.xyz, stacked, body.fibres.w) * body.detail.x;
}

@fragment
fn tissue_fragment(in: Varyings) -> @location(0) vec4f {
    let to_eye = normalize(globals.eye.xyz - in.position);
    var normal = normalize(in.normal);
    var tone = 0.62;
    if (DETAIL == 1u) {
        let texel = textureSampleLevel(
            tissue_map, tissue_sampler, looked_up(in.rest), globals.levels.x,
        );
        let slope = (texel.rgb - 0.5) * body.detail.y;
        normal = normalize(normal - slope + normal * dot(slope, normal));
        if (SHADING != 0u) {
            tone = texel.a;
        }
    }
    let own = mix(body.dark.rgb, body.light.rgb, clamp((tone - 0.3) / 0.7, 0.0, 1.0));
    var color = mix(body.vessel.rgb, own, smoothstep(0.0, 0.3, tone));

    var towards = globals.key.xyz;
    var strength = 1.0;
    if (globals.key.w > 0.5) {
        let away = globals.key.xyz - in.position;
        strength = min(globals.key_color.w / dot(away, away), 2.5);
        towards = normalize(away);
    }
    let open = in.rest.w
        * left_by(globals.tools[0], in.position, normal)
        * left_by(globals.tools[1], in.position, normal);
    let facing = dot(normal, towards);
    // Light enters tissue and comes out beside, red farthest.
    let wrap = vec3f(0.42, 0.24, 0.20);
    let soft = clamp((vec3f(facing) + wrap) / (1.0 + wrap), vec3f(0.0), vec3f(1.0));
    let around = mix(globals.ground.rgb, globals.sky.rgb, 0.5 + 0.5 * dot(normal, globals.up.xyz));
    let lit = lit_beside(globals.tools[0], in.position, towards)
        * lit_beside(globals.tools[1], in.position, towards);
    let key = globals.key_color.rgb * strength * mix(0.35, 1.0, open) * mix(0.25, 1.0, lit);
    let arriving = soft * soft * key + around * open;

    let seen = clamp(dot(normal, to_eye), 0.0, 1.0);
    let grazing = 1.0 - seen;
    let film = body.detail.w * (0.05 + 0.75 * grazing * grazing * grazing * grazing);
    let half_way = clamp(dot(normal, normalize(towards + to_eye)), 0.0, 1.0);
    // A sharp and a broad lobe, as Gaussians of the half angle.
    let glint = 1.5 * exp2(420.0 * (half_way - 1.0)) + 0.16 * exp2(36.0 * (half_way - 1.0));
    var shine = key * glint * body.detail.w;
    if (SHADING >= 2u) {
        let reflection = mirrored(2.0 * dot(normal, to_eye) * normal - to_eye);
        color = mix(color, 0.55 * reflection, body.detail.z);
        shine += reflection * film * open * (0.4 + 0.6 * strength);
    } else {
        shine += around * film * open;
    }
    let ring = mark(globals.marks[0], in.rest.xyz) + mark(globals.marks[1], in.rest.xyz);
    let light = mix(color * arriving + shine, vec3f(0.10, 0.62, 0.54), min(0.75 * ring, 1.0));
    return framed(developed(light), in.clip.xy);
}
