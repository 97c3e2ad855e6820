//! Results of `shader/film.wgsl`, computed by the adapter itself.

use crate::Gpu;

/// Angles of view, evenly by their cosine.
const VIEWS: usize = 20;
const ROUGHNESS: [f32; 2] = [0.20, 0.40];

/// Per view: reflectance, what a white body under the film sends back of light from all sides in red and in blue,
/// and what the film alone reflects of it, smooth and rough. Directions are drawn evenly by the squared cosine.
const ASKED: &str = "
@group(0) @binding(0) var<storage, read_write> answers: array<f32>;
@compute @workgroup_size(1)
fn ask(@builtin(global_invocation_id) id: vec3u) {
    let cosine = (f32(id.x) + 0.5) / 20.0;
    let to_eye = vec3f(sqrt(1.0 - cosine * cosine), 0.0, cosine);
    var body = vec3f(0.0);
    var film = vec2f(0.0);
    for (var i = 0u; i < 256u; i++) {
        let up = sqrt((f32(i) + 0.5) / 256.0);
        for (var j = 0u; j < 256u; j++) {
            let turn = 6.2831853 * (f32(j) + 0.5) / 256.0;
            let flat = sqrt(1.0 - up * up);
            let towards = vec3f(flat * cos(turn), flat * sin(turn), up);
            let normal = vec3f(0.0, 0.0, 1.0);
            body += scattered(vec3f(up), WRAP) / up;
            film.x += glitter(normal, towards, to_eye, 0.20) / up;
            film.y += glitter(normal, towards, to_eye, 0.40) / up;
        }
    }
    let sent = wetted(vec3f(1.0)) * leaving(fresnel(cosine)) * body / 65536.0;
    answers[5u * id.x] = fresnel(cosine);
    answers[5u * id.x + 1u] = sent.r;
    answers[5u * id.x + 2u] = sent.b;
    answers[5u * id.x + 3u] = film.x / 65536.0;
    answers[5u * id.x + 4u] = film.y / 65536.0;
}
";

/// The answers by view; none where there is no adapter.
fn answers() -> Option<Vec<[f32; 5]>> {
    let gpu = Gpu::open().ok()?;
    let source = format!("{}{ASKED}", include_str!("shader/film.wgsl"));
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some("ask"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
    let buffer = |usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: (VIEWS * size_of::<[f32; 5]>()) as u64,
            usage,
            mapped_at_creation: false,
        })
    };
    let written = buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let read = buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: written.as_entire_binding(),
        }],
    });
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(VIEWS as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&written, 0, &read, 0, written.size());
    gpu.queue.submit([encoder.finish()]);
    read.slice(..)
        .map_async(wgpu::MapMode::Read, |mapped| mapped.unwrap());
    gpu.wait().unwrap();
    let bytes = read.slice(..).get_mapped_range().unwrap();
    let numbers: &[[f32; 5]] = bytemuck::cast_slice(&bytes);
    Some(numbers.to_vec())
}

/// Fresnel's equations for unpolarised light that meets water.
fn exact(cosine: f64) -> f64 {
    let index = 1.33;
    let inside = (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
    let across = (cosine - index * inside) / (cosine + index * inside);
    let along = (inside - index * cosine) / (inside + index * cosine);
    0.5 * (across * across + along * along)
}

/// Judge: Fresnel's equations. At an index of 1.33 Schlick's formula, with 2.01 % straight on, leaves them by at most
/// 0.0600, at a cosine of 0.108: a property of the formula, to which rounding adds less than 0.001.
#[test]
fn film_reflects_as_fresnel_says_and_most_at_grazing_angles() {
    let Some(answers) = answers() else { return };
    for (view, answer) in answers.iter().enumerate() {
        let cosine = (view as f64 + 0.5) / VIEWS as f64;
        let off = f64::from(answer[0]) - exact(cosine);
        assert!(
            off.abs() < 0.061,
            "{cosine}: {} {}",
            answer[0],
            exact(cosine)
        );
    }
    assert!(answers.windows(2).all(|pair| pair[0][0] > pair[1][0]));
    // 2 % straight on, more than half close to grazing.
    assert!(answers[VIEWS - 1][0] < 0.021 && answers[0][0] > 0.5);
}

/// Judge: conservation of energy. Light from all sides on white tissue: what the film reflects and what comes out
/// of the body are together no more than what arrived, in every direction of view and for every roughness. The
/// film reflects no more than Fresnel's mean allows, and some.
#[test]
fn wet_tissue_sends_back_no_more_light_than_it_receives() {
    let Some(answers) = answers() else { return };
    for (view, [_, red, blue, films @ ..]) in answers.iter().enumerate() {
        for (film, roughness) in films.iter().zip(ROUGHNESS) {
            for body in [red, blue] {
                assert!(film + body <= 1.0, "{view} {roughness}: {film} + {body}");
            }
            assert!(*film > 0.015, "{view} {roughness}: {film}");
        }
    }
}
