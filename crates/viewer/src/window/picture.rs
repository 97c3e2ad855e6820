use std::time::Duration;

use eframe::egui::{self, PointerButton, Rect, Response, Sense, Vec2};
use eframe::egui_wgpu::RenderState;
use palpate_files::scene::{Enhancement, Goal, Shading, Tool};
use palpate_geometry::Vec3;
use palpate_simulate::ShownTool;

use super::attempt::Attempt;
use super::gesture::{Gesture, GestureContext, Mouse};
use super::ghosts::{Over, nearest_lump};
use super::hands::gamepad::{Pad, PadPart, PadRequests};
use super::hands::gamepads::Gamepads;
use super::hands::{Drive, Hand, HandContext, keys};
use super::overlay;
use super::play::Play;
use super::render_quality::RenderQuality;
use super::shown_picture::{PicturePainter, ShownPicture, pixels};

use crate::render::{Body, Looks, Renderer, Target, ToolPicture, View};
use crate::{Camera, Error, Gpu, Orbit, TissuePicture, pick, scene_camera};

/// Turn of the camera per point of the window [rad].
const TURN: f64 = 0.007;

/// A script's tool that is farther from its hand than this was taken up anew [m].
const TAKEN_UP: f64 = 0.01;

/// Where the organ is seen and touched.
pub(super) struct OrganView {
    pub(super) shading: Shading,
    pub(super) looks: Looks,
    pub(super) endoscope: bool,
    /// How the whole organ is shown around its contacts, if not as the scene wants it.
    pub(super) enhancement: Option<Enhancement>,
    pub(super) render_quality: RenderQuality,
    pub(super) gesture: Gesture,
    /// One per tool.
    pub(super) hands: Vec<Hand>,
    /// Where a script has the tools; none where hands have them.
    pub(super) shown: Option<Vec<Option<ShownTool>>>,
    /// Whether the keys are listed.
    pub(super) lists_keys: bool,
    pub(super) gamepads: Gamepads,
    /// Actions of gamepads that happen once.
    requests: PadRequests,
    /// Whether a key or a stick moves a hand.
    driven: bool,
    orbit: Option<Orbit>,
    /// From where the last picture was taken.
    camera: Option<Camera>,
    /// The left button went down next to the organ: it turns the camera.
    turning: bool,
    renderer: Renderer,
    /// Paints the picture into the window; none before the first.
    painter: Option<PicturePainter>,
    target: Option<(Target, ShownPicture)>,
    /// What the target shows; what would look the same is not drawn again.
    drawn: Option<(View, Vec<ToolPicture>, u64)>,
}

impl OrganView {
    pub(super) fn new(gpu: &Gpu, shading: Shading) -> Self {
        Self {
            shading,
            looks: Looks::ALL,
            endoscope: false,
            enhancement: None,
            render_quality: RenderQuality::new(gpu.is_software()),
            gesture: Gesture::default(),
            hands: Vec::new(),
            shown: None,
            lists_keys: false,
            gamepads: Gamepads::default(),
            requests: PadRequests::default(),
            driven: false,
            orbit: None,
            camera: None,
            turning: false,
            renderer: Renderer::new(gpu),
            painter: None,
            target: None,
            drawn: None,
        }
    }

    /// Shows the organ of `play` as it was chosen.
    pub(super) fn enhance(&mut self, gpu: &Gpu, play: &mut Play) -> Result<(), Error> {
        self.drawn = None;
        match self.enhancement {
            None => Ok(()),
            Some(wanted) => play.organ.enhance(gpu, &play.simulation, wanted),
        }
    }

    /// Frames the organ anew with the next picture.
    pub(super) fn reset_framing(&mut self) {
        self.orbit = None;
        self.drawn = None;
        self.release_tools();
    }

    /// Looks from where another picture looks.
    pub(super) fn copy_view(&mut self, other: &Self) {
        (self.orbit, self.endoscope) = (other.orbit, other.endoscope);
    }

    /// All hands let go of their tools.
    pub(super) fn release_tools(&mut self) {
        self.gesture = Gesture::default();
        self.hands.clear();
    }

    /// Whether somebody presses, pulls or moves a tool, or may do so without telling the window.
    pub(super) fn is_busy(&self) -> bool {
        let pulls = self.hands.iter().any(Hand::is_pulling);
        let moves = self.gesture.is_pressing() || self.gesture.is_returning();
        moves || pulls || self.driven
    }

    /// Whether there is a gamepad, which does not wake the window.
    pub(super) fn has_gamepad(&self) -> bool {
        self.gamepads.is_any()
    }

    /// Takes the actions of gamepads since the last call.
    pub(super) fn take_requests(&mut self) -> PadRequests {
        std::mem::take(&mut self.requests)
    }

    /// Lays a picture around the organ.
    pub(super) fn surround(&mut self, gpu: &Gpu, picture: Option<&TissuePicture>) {
        self.drawn = None;
        self.renderer.surround(gpu, picture);
    }

    /// The picture in what is left of `ui`, and what the mouse does in it.
    pub(super) fn show(
        &mut self,
        ui: &mut egui::Ui,
        state: &RenderState,
        gpu: &Gpu,
        play: &mut Play,
        tool: usize,
    ) -> Rect {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        overlay::describe(&response, play, tool);
        let aspect = f64::from(rect.width() / rect.height().max(1.0));
        let mesh = play.surface().mesh();
        let (low, high) = mesh.bounds();
        let extent = (high - low).norm();
        let view = &play.scene.view;
        let mut orbit = self.orbit.unwrap_or_else(|| {
            let framing = Orbit::framing(mesh, view.field_of_view_rad, aspect);
            framing.from_the_side_of(&scene_camera(view, mesh, None, aspect))
        });
        self.steer(ui, &response, &mut orbit, extent);
        let before = orbit.before(mesh, &play.tree);
        // The eye stays outside of the organ.
        orbit.distance = orbit.distance.max(before + 0.12 * extent);
        self.orbit = Some(orbit);
        let camera = match self.endoscope {
            true => orbit.endoscope(before),
            false => orbit.camera(),
        };
        self.camera = Some(camera);
        let room = HandContext {
            camera: &camera,
            aspect,
            middle: (0.5 * (low + high), extent),
        };
        self.take_up(play, &room);
        match self.shown.take() {
            Some(tools) => {
                self.driven = true;
                for (number, (hand, tool)) in self.hands.iter_mut().zip(&tools).enumerate() {
                    if let Some(tool) = tool {
                        // Taken up over the organ, without a way there from where it lay.
                        let far = hand
                            .place
                            .is_none_or(|(at, _)| (at - tool.tip).norm() > TAKEN_UP);
                        hand.show(tool, &room);
                        play.hold(number, hand, far.then_some(tool.tip));
                    }
                }
            }
            None => {
                self.drive(ui, play, tool, &room);
                self.touch(ui, &response, rect, play, tool, &room);
            }
        }
        let size = pixels(rect, ui.ctx().pixels_per_point());
        let shown = self.draw(state, gpu, play, &camera, extent, size);
        ui.painter().add(shown.at(rect));
        rect
    }

    /// Draws a task over the picture: the work to do, and afterwards the solution.
    pub(super) fn show_task(
        &self,
        ui: &egui::Ui,
        rect: Rect,
        play: &mut Play,
        attempt: Option<&Attempt>,
    ) {
        let (Some(camera), Some(attempt)) = (&self.camera, attempt) else {
            return;
        };
        let painter = ui.painter_at(rect);
        let over = Over {
            painter,
            rect,
            camera,
        };
        match &attempt.task.goal {
            Goal::Cut { line, .. } => {
                over.wanted(line);
                over.left(&attempt.uncut());
            }
            Goal::Traction {
                direction: Some((direction, _)),
                tool,
                ..
            } if !attempt.is_over() => {
                let named = |own: &Tool| tool.as_ref().is_none_or(|name| own.name == *name);
                let number = play.scene.tools.iter().position(named).unwrap_or(0);
                let seen = play.source.snapshot().tools.get(number);
                if let Some(pose) = seen.and_then(|seen| seen.pose) {
                    over.arrow(&Vec3::from(pose.position_m), &Vec3::from(*direction));
                }
            }
            Goal::Touch(touch) => {
                let target = Vec3::from(touch.target_m);
                let is_covered = play.covers(&target, &camera.eye);
                over.target(&target, touch.tolerance_m, is_covered);
            }
            Goal::Find { target_m, .. } if attempt.is_over() => {
                let lumps = &play.scene.organ.estimated_inclusions;
                for lump in lumps {
                    let (middle, radius) =
                        (Vec3::from(lump.middle()), lump.shape.smallest_radius());
                    over.lump(&middle, radius);
                    if let Some(stated) = attempt.stated_diameter() {
                        over.stated(&middle, 0.5 * stated, radius);
                    }
                }
                if let Some(marked) = attempt.marked {
                    let target = Vec3::from(*target_m);
                    over.mark(&marked, &nearest_lump(lumps, target));
                }
            }
            _ => {}
        }
        over.tools(&attempt.ghosts);
    }

    /// Turns, moves and zooms the camera.
    fn steer(&mut self, ui: &egui::Ui, response: &Response, orbit: &mut Orbit, extent: f64) {
        let drag = response.drag_delta();
        let turns = response.dragged_by(PointerButton::Secondary)
            || self.turning && response.dragged_by(PointerButton::Primary);
        if turns {
            orbit.turn(-TURN * f64::from(drag.x), TURN * f64::from(drag.y));
        }
        if response.dragged_by(PointerButton::Middle) {
            let [right, up, _] = orbit.camera().axes();
            let points = f64::from(response.rect.height().max(1.0));
            let height = 2.0 * orbit.distance * (0.5 * orbit.field_of_view).tan() / points;
            orbit.target += height * (f64::from(drag.y) * up - f64::from(drag.x) * right);
        }
        let wheel = f64::from(ui.input(|input| input.smooth_scroll_delta.y));
        let holds = self.gesture.is_pressing() || self.hands.iter().any(Hand::is_pulling);
        if response.hovered() && !holds && wheel != 0.0 {
            orbit.approach((-0.0025 * wheel).exp(), (0.15 * extent, 6.0 * extent));
        }
    }

    /// Tools with a trocar wait before the organ.
    fn take_up(&mut self, play: &Play, room: &HandContext<'_>) {
        let tools = &play.scene.tools;
        if self.hands.len() == tools.len() {
            return;
        }
        self.hands = vec![Hand::default(); tools.len()];
        for (hand, tool) in self.hands.iter_mut().zip(tools) {
            if let Some(trocar) = tool.trocar_m.map(Vec3::from) {
                let towards = room.middle.0 - trocar;
                let (mesh, way) = (play.surface().mesh(), towards.norm());
                if let Some(hit) = play.tree.cast(mesh, &trocar, &(towards / way), way) {
                    hand.wait(&trocar, hit.distance, room);
                }
            }
        }
    }

    /// Moves the hands by keys and sticks, and sends those that the mouse does not move to the model.
    fn drive(&mut self, ui: &egui::Ui, play: &mut Play, tool: usize, room: &HandContext<'_>) {
        let free = !ui.ctx().egui_wants_keyboard_input();
        let elapsed = f64::from(ui.input(|input| input.unstable_dt)).min(0.05);
        let pads = self.gamepads.look();
        let requests = pads.iter().map(Pad::requests);
        self.requests = requests.fold(self.requests, PadRequests::and);
        let tools = play.scene.tools.len();
        self.driven = false;
        for (number, hand) in self.hands.iter_mut().enumerate() {
            let scene_tool = &play.scene.tools[number];
            let side = side(&scene_tool.name, number);
            let of_tool = pads.iter().enumerate().filter_map(|(number, pad)| {
                Some(pad.drive(PadPart::of([number, pads.len()], side, tools)?))
            });
            let mut drive = of_tool.fold(Drive::default(), Drive::and);
            if free {
                drive = drive.and(ui.input(|input| keys::drive(&keys::HANDS[side], input)));
            }
            if number == tool {
                drive = drive.and(ui.input(|input| keys::of_mouse(input, free)));
            }
            let trocar = scene_tool.trocar_m.map(Vec3::from);
            let before = *hand;
            hand.drive(&drive, elapsed, trocar.as_ref(), room);
            self.driven |= *hand != before;
            play.hold(number, hand, None);
        }
    }

    /// Moves the tool of the mouse.
    fn touch(
        &mut self,
        ui: &egui::Ui,
        response: &Response,
        rect: Rect,
        play: &mut Play,
        tool: usize,
        room: &HandContext<'_>,
    ) {
        let Some(hand) = self.hands.get_mut(tool) else {
            return;
        };
        let aspect = room.aspect;
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let place = pointer
            .filter(|at| rect.contains(*at))
            .map(|at| (at - rect.min) / rect.size())
            .map(|part| (f64::from(part.x), f64::from(part.y)));
        let (down, moved) = ui.input(|input| {
            let moved = input.pointer.delta() != Vec2::ZERO;
            (input.pointer.primary_down(), moved)
        });
        let over = |place| pick(play.surface(), &play.tree, room.camera, place, aspect).is_some();
        let busy = self.gesture.is_pressing() || hand.is_pulling();
        if response.drag_started_by(PointerButton::Primary) && !busy {
            self.turning = !hand.holds() && !place.is_some_and(over);
        }
        self.turning &= down;
        // A press that began in the side panel is none here.
        let held = response.is_pointer_button_down_on() || busy;
        let turned = response.dragged_by(PointerButton::Secondary);
        let wheel = f64::from(ui.input(|input| input.smooth_scroll_delta.y)) / 50.0;
        let mouse = Mouse {
            place,
            pressed: down && held && !self.turning && !turned,
            wheel: if busy { wheel } else { 0.0 },
            cuts: hand.cuts,
            elapsed: f64::from(ui.input(|input| input.unstable_dt)).min(0.05),
        };
        if hand.holds() {
            hand.pull(&mouse, room);
            play.hold(tool, hand, None);
            return;
        }
        // A mouse that rests takes nothing from the keys.
        if hand.by_keys && !mouse.pressed && !(moved && place.is_some_and(over)) {
            return;
        }
        let ground = GestureContext {
            surface: play.surface(),
            tree: &play.tree,
            camera: room.camera,
            aspect,
            tip: play.scene.tools[tool].tip,
        };
        if let Some(aim) = self.gesture.follow(&mouse, &ground) {
            hand.follow(&aim);
            play.hold(tool, hand, aim.from);
        }
    }

    fn draw(
        &mut self,
        state: &RenderState,
        gpu: &Gpu,
        play: &mut Play,
        camera: &Camera,
        extent: f64,
        size: (u32, u32),
    ) -> ShownPicture {
        let shown = self.target(state, gpu, size);
        let snapshot = play.source.snapshot();
        let tools: Vec<ToolPicture> = play
            .scene
            .tools
            .iter()
            .zip(&snapshot.tools)
            .zip(play.simulation.tools())
            .filter_map(|((tool, seen), model)| {
                let pose = seen.pose?;
                let picture = ToolPicture::new(tool, pose.position_m, seen.orientation)
                    .looking_like(model.display_mesh.as_ref())
                    .gripping(pose.grip);
                Some(match seen.contact {
                    Some(contact) => picture.touching(contact.point),
                    None => picture,
                })
            })
            .collect();
        let view = View {
            camera: *camera,
            shading: self.shading,
            looks: self.looks,
            reach: extent,
        };
        // Places, not forces: tissue that relaxes looks the same. A slow machine has better things to do.
        let opened = snapshot.opened.as_ref().filter(|opened| opened.version > 0);
        let now = (view, tools, opened.map_or(0, |opened| opened.version));
        if self.drawn.as_ref() == Some(&now) {
            return shown;
        }
        match opened {
            Some(opened) => {
                let surface = play.simulation.surface();
                play.organ.open(gpu, opened, surface, &snapshot.vertices);
            }
            None => play
                .organ
                .deform(gpu, &snapshot.vertices, snapshot.organ_field.as_ref()),
        }
        let bodies: Vec<&Body> = play.organ.bodies().chain(&play.neighbours).collect();
        if let Some((target, _)) = &self.target {
            let (view, tools, _) = &now;
            self.renderer.draw(gpu, view, &bodies, tools, target);
        }
        self.drawn = Some(now);
        shown
    }

    /// What the picture is drawn into, made anew when its `size` [pixels] in the window or the effort has changed.
    fn target(&mut self, state: &RenderState, gpu: &Gpu, size: (u32, u32)) -> ShownPicture {
        let scale = self.render_quality.scale();
        let scaled = |side: u32| ((side as f32 * scale).round() as u32).max(1);
        let size = (scaled(size.0), scaled(size.1));
        let samples = self.render_quality.samples();
        if let Some((target, shown)) = &self.target
            && target.size() == size
            && target.samples() == samples
        {
            return shown.clone();
        }
        let target = Target::new(gpu, size, samples);
        self.drawn = None;
        let format = state.target_format;
        let painter = self
            .painter
            .get_or_insert_with(|| PicturePainter::new(gpu, format));
        let shown = painter.shown(gpu, &target);
        self.target = Some((target, shown.clone()));
        shown
    }

    /// Counts a picture for the effort.
    pub(super) fn count(&mut self, time: Duration, touch_is_late: bool) {
        self.render_quality.count(time, touch_is_late);
    }
}

/// Whose keys move a tool: the left hand's (0) or the right one's (1).
fn side(name: &str, number: usize) -> usize {
    match name {
        "left" => 0,
        "right" => 1,
        _ => number.min(1),
    }
}
