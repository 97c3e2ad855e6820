# The texts of the trainer's window in English. A phrase has a key, a text, and placeholders { $name }; Fluent's guide
# explains the format: https://projectfluent.org/fluent/guide. The unit of a number is part of the text.

## On several pages
common-back = Back
common-tasks = Tasks
common-replay = Replay
common-free-play = Free play
common-untitled = Task without a title
common-demonstration = demonstration (script)
common-passed = passed
common-not-passed = not passed
common-or-key = or { $key }
common-time-errors =
    { $s } s, { $errors ->
        [one] 1 error
       *[other] { $errors } errors
    }
hand-left = left
hand-right = right
key-enter = Enter
key-shift = Shift
key-tab = Tab
key-backspace = Backspace
key-space = Space
key-esc = Esc
key-drag = drag

## Tasks that come with the program: the same texts as in assets/tasks
task-palpation = Palpation
task-palpation-what = A lump lies under the front of this liver, each time in another place. Press here and there, always to the same depth: over the lump the force is higher. Press on it and mark it with Enter. Then state its diameter, between 13 and 21 mm: the larger the lump, the higher the force over it, compared with the force beside it.
task-traction = Traction
task-traction-what = Grasp the esophagus with the left hand and pull it along the arrow, until the force is in its band. Hold it there. How hard to pull, and where to, changes with each attempt. A pull above 0.6 N tears the tissue.
task-myotomy = Myotomy
task-myotomy-what = Hold the esophagus beside the line with the left hand. With the right one cut its muscle along the line: first the outer, longitudinal muscle (0.7 mm deep), then in its opening the circular muscle (1.5 mm). Leave the mucosa: a blade 2.3 mm deep or a press above 0.5 N perforates it. What is still to be cut shines.
task-retraction = Retraction
task-retraction-what = The left lobe of this liver covers a spot of the stomach, the target: a dashed ring shows where it lies, a full ring that you see it. Grasp the rim of the lobe above it with the left hand and lift it. Then touch the target with the right hand, gently, and stay there. A pull above 1.2 N tears the liver, and more than 0.5 N on the stomach injures it.
task-cutting = Precision cutting
task-cutting-what = A circle is marked on this two-layered sheet, each time in another place and of another size. Hold the sheet outside of the circle with the left hand. With the right one cut the upper layer along the line, all around: at least 1.5 mm deep, and less than 4 mm, where the lower layer is cut through. No part of the cut may be more than 2 mm from the line. What is still to be cut shines.

## Start screen
home-subtitle = Touch simulated organs and practise surgical tasks
home-you = You
home-name = Name
home-name-hint = Your results are stored under this name.
home-sessions-in = Sessions are stored in { $folder }
home-no-results = No results yet.
home-free-hint = Touch, hold, pull and cut as you like. Nothing is recorded.
home-open = Open
home-open-task = Open { $task }
home-tried =
    { $count ->
        [one] tried once
       *[other] tried { $count } times
    }, passed { $passed }; the last one took { $s } s
home-learning = { $task }: time [s] over attempts
home-replay-session = Replay { $task }, { $date }
home-assigned =
    { $task }: pass { $passes ->
        [one] once
       *[other] { $passes } times
    } by { $due }; { $passed } so far
home-limits = What this program does not do: there is no bleeding, no smoke and no suturing; neighbouring organs stop the tips of tools, and an organ that bends, but no shafts; a mouse displays no force. It is not a certified medical device, and no study has shown that a score here predicts one in an operating room.
standing-done = done
standing-open = open
standing-late = late

## Attempt
attempt-begin = Begin
attempt-begin-ready = Begin when ready
attempt-watch = Watch demonstration (script)
attempt-preparing = preparing the organ, { $percent } %
attempt-preparing-begins = preparing the organ, { $percent } %; then it begins
attempt-recorded = recorded
attempt-not-recorded = NOT RECORDED
attempt-time = { $s } s
attempt-time-left = { $s } s left
attempt-end = End
attempt-part = part of the task that is done
attempt-gauge = Force { $mn } mN; it should be between { $low } and { $high } mN
attempt-perforated =
    perforated { $count ->
        [one] once
       *[other] { $count } times
    }
attempt-elsewhere = The session is in memory, its first 20 minutes at least. Record all of it in another folder:
attempt-record-there = Record there
attempt-no-expert = without an expert: { $error }
attempt-scene-changed = not recorded: the scene was changed in this window, so that a recording could not be replayed
attempt-unrecorded = not recorded: { $error }
fact-free = Enter ends it.
fact-find = Enter marks the place that you press on, and ends the attempt.
fact-find-size = Enter marks the place that you press on. Then set the diameter with the left and right arrow keys, and Enter states it; ± { $mm } mm counts.
fact-hold = Hold { $mn } ± { $tolerance } mN for { $s } s in all; then the attempt ends by itself.
fact-touch = Touch the target with { $mn } ± { $tolerance } mN for { $s } s in all; then the attempt ends by itself. A touch counts while neither tip nor shaft of the tool touches the organ.
fact-cut = The attempt ends by itself when the line is cut; Enter ends it before.
fact-time = You have { $s } s.
fact-force = A force above { $mn } mN counts as an error.
fact-expert = Bright outlines show how an expert did it.
fact-shown = That was the demonstration (script). Begin draws new numbers for your attempt.
cue-hold = hold
cue-harder = pull harder
cue-less = pull less
cue-turn = pull along the arrow
cue-too-hard = too hard
cue-press-harder = press harder
cue-press-less = press less
cue-grasp = grasp the rim
cue-lift = lift: organ in the way
cue-reach = lift, then touch the target
cue-on-line = on the line
cue-inside = { $mm } mm inside the line
cue-outside = { $mm } mm outside the line
cue-beside = { $mm } mm off the line
diameter-title = Marked. How large is the lump?
diameter-slider = Diameter [mm]
diameter-state = State the diameter
diameter-keys = left and right arrow keys, or the slider

## Result: the verdict, and its reason as the end of the sentence
verdict-passed = Passed
verdict-late = Not passed: the time was over
verdict-not-passed = Not passed: { $why }
verdict-done = Done
why-unmarked = no place was marked
why-no-diameter = no diameter was stated
why-diameter = the diameter is { $mm } mm, not { $stated } mm
why-far = the mark is { $mm } mm from the lump
why-torn = the tissue tore under { $mn } mN
why-short = the pull was right for { $s } s only
why-held-torn = the held tissue tore under { $mn } mN
why-injured = the target was injured by { $mn } mN
why-covered = the organ was not held out of the way
why-touched-short = the target was touched for { $s } s only
why-beside = the tip stayed { $mm } mm from the target
why-perforated = the layer that should stay whole is perforated
why-off-line = the cut is { $mm } mm from the line
why-uncut = { $percent } % of the line is not cut
why-unknown = see the measures
good-found = Good: you found the lump, { $mm } mm from its middle.
good-found-size = Good: you found the lump, { $mm } mm from its middle, and stated { $stated } mm for its diameter of { $truth } mm.
good-held = Good: you held the pull, { $mn } mN off on average.
good-touched = Good: you held the organ out of the way and touched the target for { $s } s.
good-clear = Good: the organ was out of the way of your tool.
good-cut = Good: the whole line is cut, and the layer below is intact.
good-part = Good: { $percent } % of the line is cut to its depth.
good-within = Good: the pull was right for { $s } s.
good-gentle = Good: you stayed below { $mn } mN, with { $most } mN at most.
good-worked = Good: you worked for { $s } s.
change-mark = Change: press, and mark with Enter while you press.
change-rows = Change: press to the same depth everywhere, in rows 15 mm apart, and compare the forces.
change-smaller = Change: state a smaller diameter for such a rise of the force.
change-larger = Change: state a larger diameter for such a rise of the force over the lump.
change-slower = Change: pull more slowly: tissue keeps yielding, and a fast pull overshoots.
change-grasp = Change: grasp first, then pull until the cue says hold, and stay there.
change-lift-slower = Change: lift more slowly and less far, and grasp nearer to what is in the way.
change-come-slowly = Change: come slowly for the last millimetres, and stop at the first force.
change-lift = Change: grasp the rim of the organ over the target, and lift it until neither tip nor shaft of the other tool touches the organ.
change-stay = Change: keep the organ lifted, and stay on the target until its time is over.
change-shallower = Change: lower the blade less deep, and do not press on the exposed layer.
change-uncut = Change: cut what still shines on the organ, to its full depth.
change-line = Change: stay on the line.
change-gentler =
    Change: press more gently: the force rose above { $mn } mN { $count ->
        [one] once
       *[other] { $count } times
    }.
change-drops =
    Change: pull less on what you hold: it slipped { $count ->
        [one] once
       *[other] { $count } times
    }.
change-shaft =
    Change: keep the shaft off the organ: it touched { $count ->
        [one] once
       *[other] { $count } times
    }.
change-nothing = Change: nothing; there was no error.
next-repeat = Next: repeat it, with other numbers, in less than { $s } s and without errors.
next-retry = Next: watch the demonstration if the way is not clear, then try again.
next-choose = Next: choose a task.
result-retry = Retry
result-compare = Replay next to the demonstration
result-computing = computing the demonstration, { $percent } %
result-recorded-in = recorded in { $folder }
result-not-kept = the result is not stored: { $trouble }
result-measures = All measures
result-force = Force [mN] over time [s]
result-force-limit = Force [mN] over time [s], and its limit
result-force-band = Force [mN] over time [s], and its band
result-force-most = { $plot }; at most { $mn } mN
result-first = This was your first attempt.
result-attempts = Your attempts
result-now = now
result-you = you
result-experts = experts
result-proficient = proficient
result-not-yet = not yet
measure-time-s = time
measure-path-m = path
measure-angular-path-rad = angular path
measure-path-along-shaft-m = path along the shaft
measure-economy = economy of motion
measure-jerk = jerk
measure-contact-time-s = contact time
measure-peak-force-n = peak force
measure-mean-force-n = mean force
measure-force-time-n-s = force integral
measure-peak-grip-force-n = peak grip force
measure-time-above-limit-s = time above the limit
measure-damage-n-s = force integral above the limit
measure-force-limit-errors = force limit errors
measure-perforations = perforations
measure-drops = drops
measure-shaft-contacts = shaft contacts
measure-undone-cuts = undone cuts
measure-cut-length-m = length of the cut
measure-cut-part = part of the line that is cut
measure-cut-mean-deviation-m = mean deviation from the line
measure-cut-largest-deviation-m = largest deviation from the line
measure-cut-deviation-area-m2 = area between the cut and the line
measure-beside-m = distance from the target
measure-diameter-error-m = error of the diameter
measure-held-s = time within the band
measure-traction-error-n = mean error of the traction

## Replay
replay-play = Play
replay-stop = Stop
replay-leave = Leave
replay-time = Time of the session
replay-at = { $at } of { $end } s
replay-own = your attempt
replay-no-scene = { $folder } has no scene.toml, so that it cannot be replayed
demonstration-none = the task has no demonstration

## Settings
settings-title = Settings
settings-hands = Hands
settings-mouse = The mouse moves
settings-mouse-scene = the tool that the scene names
settings-mouse-left = the left hand’s tool
settings-mouse-right = the right hand’s tool
settings-other-hand = Keys move both hands at once: W A S D the left one, I J K L the right one. Tab hands the mouse the other tool.
settings-language = Language
settings-system = that of the system
settings-translated = { $translated } of { $all } phrases are in this language; the others, engineering figures and error messages are English.
settings-display = Display
settings-scale = Size of texts and buttons
settings-folders = Folders
settings-sessions = Sessions and results
settings-file = Settings
settings-cached = Cache
settings-training-folder = Folder of sessions and results
settings-training-hint = empty: the folder of the system
settings-set-folder = Set the folder
settings-next-start = It is used from the next start on.
settings-cache = Cache of prepared organs
settings-cache-use =
    { $files ->
        [one] 1 file
       *[other] { $files } files
    }, { $mb } MB
settings-clear-cache = Clear the cache
settings-clear-hint = Each organ is prepared again when it is needed.
settings-devices = Devices
settings-find-devices = Look for devices
settings-gamepad = Gamepad: { $name }
settings-no-gamepad = Gamepad: none is plugged in, or none may be read

## Trainees, for a teacher
class-title = Trainees
class-assignments = Assignments
class-no-assignment = Nothing is assigned yet.
class-assigned =
    { $task }, { $cohort }: pass { $passes ->
        [one] once
       *[other] { $passes } times
    } by { $due }
class-assign = Assign
class-to = cohort or trainee
class-task = task
class-due = due date
class-passes = passed attempts required
class-pin = teacher’s PIN, if there is one
class-given = { $task } is assigned to { $to }, by { $due }
class-nobody = Nobody has attempted a task yet, and there is no cohort: `palpate teacher cohort NAME --add TRAINEE` begins one.
class-learning = Learning curves
class-no-attempt = No attempt is recorded yet.
class-times = Time [s] over attempts
class-trainee = trainee
class-standing = standing
class-passed = passed
class-attempts = attempts
class-proficient = proficient since attempt
class-each = each trainee
class-mean = mean of trainees
class-experts = mean of experts

## In the picture
picture-organ = Picture of the organ
picture-tool = { $tool }: { $mm } mm deep, { $mn } mN
picture-lump = the lump
picture-stated = the size you stated
picture-target = the target
picture-mark = your mark
hint-touch = press on the organ: touch, then drag down to go deeper · right drag: turn · middle drag: move · wheel: zoom · ?: keys
hint-pulling = drag: pull · wheel: to and fro · G: open the jaws
hint-shut = the jaws are shut · drag: pull · G: open them · ?: keys
hint-slips = drag down: deeper · up: out · sideways: slide · wheel: fine · release: leave
hint-sticks = drag down: deeper · up: out · sideways: this tip sticks and drags the tissue · release: leave
hint-sticks-and-slides = drag down: deeper · up: out · sideways: the tip drags the tissue, then slides · release: leave
hint-replay = right drag: turn · middle drag: move · wheel: zoom · P: play or stop
hint-paused = paused · P: continue
keys-title = keys
keys-move = up · left · down · right
keys-shaft = in · out, along the shaft
keys-roll = roll
keys-jaws = jaws: close or open
keys-cut = cut, while held
keys-fine = slower
keys-other-tool = the mouse takes the other tool
keys-mouse-tool = jaws · cut of the mouse’s tool
keys-drag = press in; cutting: along; jaws shut: pull
keys-undo = undo a cut
keys-pause = pause or continue
keys-reset = restart
keys-mark = mark the place, or end
keys-stop = emergency stop: no device displays a force
keys-engineer = engineer’s view, or trainee’s view
keys-list = this list

## Beside the picture
preparing-organ = preparing the organ and its model
preparing-force = the tissue’s force over depth
preparing-reading = the organ’s stored response
preparing-influences = the organ’s response: influences
preparing-tetrahedra = the organ’s response: tetrahedra
preparing-factors = the organ’s response: factors
preparing-responses = the organ’s response: a force on each triangle
preparing-left = about { $seconds } s left
preparing-storing = storing the organ’s response
absence-way-out = Open the built-in esophagus
fault-thread = one of its threads ended
fault-stopped = the simulation has stopped: { $why }; press Restart
stop-emergency = EMERGENCY STOP
stop-hint = no force at once (space bar); forces stay off until you arm them again
stop-arm = Arm forces
stop-arm-hint = forces return over half a second, once the hand is slow and the force small
warning-deep = deeper than 10 mm no model here has been compared with tissue
warning-none = no warnings
warning-more = { $first } (and { $more } more)
panel-restart = Restart
panel-organ = organ
panel-tissue = tissue
panel-model = model
panel-tool = tool
panel-tip = tip
panel-radius = radius
panel-of-scene = of the scene
panel-local = around the tip
panel-hybrid = global model, linear
panel-nonlinear = global model, large deformation
panel-flat = flat
panel-ball = ball
panel-sticks = sticks
panel-slips = slips
look-plain = plain
look-texture = texture
look-sphere-map = sphere map
look-cube-map = cube map
look-orbit = orbit
look-endoscope = endoscope
look-frame = frame
look-whole = the whole organ
look-relief = relief
look-drop = drop a PNG here: the maps are made of it
look-maps = maps: { $path }
look-own = own
felt-scale = a device displays the force × { $scale } (force_scale of the scene)
felt-force = force [mN]
felt-depth = depth [mm]
rates-display = display
rates-pictures = { $rate } Hz, { $samples }×, { $pixels } % of the pixels
rates-model = model
rates-servo = servo
rates-of = { $rate } of { $wanted } Hz, { $priority }
priority-real-time = real-time priority
priority-ordinary = ordinary priority
quality-late = late
quality-late-hint = how long after its time a tick began: p50, p99, p99.9, longest
quality-times = { $median }, { $most }, { $nearly }, { $longest } µs
quality-left-out = left out
quality-left-out-hint = ticks and steps whose time had passed; they are never made up for
quality-missed = { $ticks } ticks, { $steps } steps
quality-between = between
quality-between-hint = how far the force between the model’s answers was from what it then found: root of the mean square, largest
quality-off = off by { $mean }, at most { $most } mN
quality-energy = energy
quality-energy-hint = work that the loop did on the hand; tissue only takes some
quality-work = { $work } mJ to the hand
quality-limits = limits
quality-limits-hint = ticks in which a force was changed on its way to the hand: late { $late }, faded { $faded }, damped { $damped }, walls { $walls }, saturated { $saturated }, thermally limited { $thermal }, rate limited { $rate }; dead-man switch released { $released } times
quality-forces-off = forces are off
quality-faults = { $ticks } ticks, { $faults } faults
finer-none = around a tip the global model can show finer triangles
finer-carried = { $shown } triangles are shown, embedded in { $solved } that are solved
finer-solved = { $solved } triangles are solved and shown
finer-title = finer (F2)
finer-hint = which triangles around the touched one are refined: none, those that share an edge with it, or those that share a vertex
finer-no = no
finer-edge = edge
finer-vertex = vertex
finer-levels = how often each triangle is split into four
smooth-title = smooth (F3)
smooth-hint = how displacements of triangles are interpolated: linearly, or by these functions
smooth-squares = least squares
