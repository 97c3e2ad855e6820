// Optics of wet tissue: a film of water over a matte body that scatters. Light is counted as what a white matte
// surface would send back: irradiance over pi.

// Reflectance of water straight on, its refractive index being 1.33.
const STRAIGHT: f32 = 0.0201;
// The same for light from all sides: the mean of `fresnel` over a hemisphere.
const FROM_ALL_SIDES: f32 = 0.0668;
// Part of the light from the body that the film reflects back into it: 1 - (1 - FROM_ALL_SIDES) / 1.33^2.
const KEPT_IN: f32 = 0.4724;

// How far light goes round the edge of a shadow in red, green and blue: blood absorbs red least.
const WRAP: vec3f = vec3f(0.42, 0.24, 0.20);

// Schlick's approximation of Fresnel's reflectance [Schlick 1994].
fn fresnel(cosine: f32) -> f32 {
    let away = 1.0 - clamp(cosine, 0.0, 1.0);
    let squared = away * away;
    return STRAIGHT + (1.0 - STRAIGHT) * squared * squared * away;
}

// Albedo of a body under the film [Lekner and Dorf 1988]. What leaves in one direction is this times
// `leaving`, whose mean over the hemisphere is 1.
fn wetted(albedo: vec3f) -> vec3f {
    return albedo * (1.0 - FROM_ALL_SIDES) * (1.0 - KEPT_IN) / (1.0 - KEPT_IN * albedo);
}

fn leaving(reflectance: f32) -> f32 {
    return (1.0 - reflectance) / (1.0 - FROM_ALL_SIDES);
}

// Light that a scattering body sends back, by the cosine of the light's angle in each colour. Wrapped by at most a
// half it sends back no more than it receives: the mean is 2 (1 + wrap) / 3.
fn scattered(cosine: vec3f, wrap: vec3f) -> vec3f {
    let soft = clamp((cosine + wrap) / (1.0 + wrap), vec3f(0.0), vec3f(1.0));
    return soft * soft;
}

// Light of a lamp at `squared` distance [m2] that is 1 at `reference` [m2].
fn fallen(squared: f32, reference: f32) -> f32 {
    return reference / max(squared, 1e-8);
}

// Light of a lamp in the direction `towards` that the film reflects to the eye: microfacets [Walter et al. 2007]
// with Smith's shadowing as [Karis 2013] approximates it.
fn glitter(normal: vec3f, towards: vec3f, to_eye: vec3f, roughness: f32) -> f32 {
    let middle = normalize(towards + to_eye);
    let facing = clamp(dot(normal, middle), 0.0, 1.0);
    let lit = clamp(dot(normal, towards), 0.0, 1.0);
    let seen = clamp(dot(normal, to_eye), 1e-3, 1.0);
    let alpha = roughness * roughness;
    let squared = alpha * alpha;
    let bend = facing * facing * (squared - 1.0) + 1.0;
    let k = 0.5 * alpha;
    let shadowing = (lit * (1.0 - k) + k) * (seen * (1.0 - k) + k);
    return 0.25 * squared * fresnel(dot(middle, to_eye)) * lit / (bend * bend * shadowing);
}
