# Die Texte des Trainers auf Deutsch. Schlüssel und Platzhalter sind die von en.ftl.

## Auf mehreren Seiten
common-back = Zurück
common-tasks = Aufgaben
common-replay = Wiedergabe
common-free-play = Freies Üben
common-untitled = Aufgabe ohne Titel
common-demonstration = Demonstration (Skript)
common-passed = bestanden
common-not-passed = nicht bestanden
common-or-key = oder { $key }
common-time-errors = { $s } s, { $errors } Fehler
hand-left = links
hand-right = rechts
key-enter = Eingabetaste
key-shift = Umschalt
key-tab = Tabulator
key-backspace = Rücktaste
key-space = Leertaste
key-esc = Esc
key-drag = ziehen

## Aufgaben
task-palpation = Palpation
task-palpation-what = Unter der Vorderseite dieser Leber liegt ein Knoten, jedes Mal an einer anderen Stelle. Drücken Sie an verschiedenen Stellen, immer gleich tief: Über dem Knoten ist die Kraft größer. Drücken Sie auf ihn und markieren Sie ihn mit der Eingabetaste. Geben Sie dann seinen Durchmesser an, zwischen 13 und 21 mm: Je größer der Knoten, desto größer ist die Kraft über ihm, verglichen mit der Kraft daneben.
task-traction = Traktion
task-traction-what = Fassen Sie den Ösophagus mit der linken Hand und ziehen Sie ihn entlang des Pfeils, bis die Kraft in ihrem Bereich liegt. Halten Sie sie dort. Wie stark und wohin zu ziehen ist, ändert sich mit jedem Versuch. Ein Zug über 0,6 N zerreißt das Gewebe.
task-myotomy = Myotomie
task-myotomy-what = Halten Sie den Ösophagus neben der Linie mit der linken Hand. Durchtrennen Sie mit der rechten seine Muskulatur entlang der Linie: zuerst die äußere Längsmuskulatur (0,7 mm tief), dann in deren Öffnung die Ringmuskulatur (1,5 mm). Schonen Sie die Mukosa: Eine 2,3 mm tiefe Klinge oder ein Druck über 0,5 N perforiert sie. Was noch zu durchtrennen ist, leuchtet.
task-retraction = Retraktion
task-retraction-what = Der linke Lappen dieser Leber verdeckt eine Stelle des Magens, das Ziel: Ein gestrichelter Ring zeigt, wo sie liegt, ein voller Ring, dass Sie sie sehen. Fassen Sie den Rand des Lappens darüber mit der linken Hand und heben Sie ihn an. Berühren Sie dann das Ziel vorsichtig mit der rechten Hand und bleiben Sie dort. Ein Zug über 1,2 N reißt die Leber ein, und mehr als 0,5 N auf den Magen verletzen ihn.
task-cutting = Präzises Schneiden
task-cutting-what = Auf dieser zweischichtigen Platte ist ein Kreis markiert, jedes Mal an einer anderen Stelle und in einer anderen Größe. Halten Sie die Platte außerhalb des Kreises mit der linken Hand. Schneiden Sie mit der rechten die obere Schicht entlang der Linie ganz herum durch: mindestens 1,5 mm tief und weniger als 4 mm, denn dort ist die untere Schicht durchtrennt. Kein Teil des Schnitts darf mehr als 2 mm neben der Linie liegen. Was noch zu schneiden ist, leuchtet.

## Startseite
home-subtitle = Simulierte Organe ertasten und chirurgische Aufgaben üben
home-you = Sie
home-name = Name
home-name-hint = Ihre Ergebnisse werden unter diesem Namen gespeichert.
home-sessions-in = Sitzungen werden in { $folder } gespeichert
home-no-results = Noch keine Ergebnisse.
home-free-hint = Tasten, halten, ziehen und schneiden Sie, wie Sie möchten. Nichts wird aufgezeichnet.
home-open = Öffnen
home-open-task = { $task } öffnen
home-tried =
    { $count ->
        [one] einmal versucht
       *[other] { $count }-mal versucht
    }, { $passed }-mal bestanden; der letzte dauerte { $s } s
home-learning = { $task }: Zeit [s] über den Versuchen
home-replay-session = { $task } vom { $date } wiedergeben
home-assigned =
    { $task }: { $passes ->
        [one] einmal
       *[other] { $passes }-mal
    } bestehen bis { $due }; bisher { $passed }-mal
home-limits = Was dieses Programm nicht leistet: Es gibt keine Blutung, keinen Rauch und keine Naht; Nachbarorgane halten die Spitzen der Instrumente und ein Organ, das sich verformt, auf, aber keine Schäfte; eine Maus gibt keine Kraft wieder. Es ist kein zugelassenes Medizinprodukt, und keine Studie hat gezeigt, dass ein Ergebnis hier eines im Operationssaal vorhersagt.
standing-done = erledigt
standing-open = offen
standing-late = überfällig

## Versuch
attempt-begin = Beginnen
attempt-begin-ready = Beginnen, sobald bereit
attempt-watch = Demonstration ansehen (Skript)
attempt-preparing = Das Organ wird vorbereitet, { $percent } %
attempt-preparing-begins = Das Organ wird vorbereitet, { $percent } %; dann beginnt der Versuch
attempt-recorded = Aufzeichnung
attempt-not-recorded = KEINE AUFZEICHNUNG
attempt-time = { $s } s
attempt-time-left = noch { $s } s
attempt-end = Beenden
attempt-part = Anteil der Aufgabe, der erledigt ist
attempt-gauge = Kraft { $mn } mN; sie soll zwischen { $low } und { $high } mN liegen
attempt-perforated =
    { $count ->
        [one] einmal perforiert
       *[other] { $count }-mal perforiert
    }
attempt-elsewhere = Die Sitzung ist im Arbeitsspeicher, mindestens ihre ersten 20 Minuten. Sie kann ganz in einen anderen Ordner aufgezeichnet werden:
attempt-record-there = Dort aufzeichnen
attempt-no-expert = ohne Vergleich mit Experten: { $error }
attempt-scene-changed = nicht aufgezeichnet: Die Szene wurde in diesem Fenster geändert, eine Aufzeichnung ließe sich nicht wiedergeben
attempt-unrecorded = nicht aufgezeichnet: { $error }
fact-free = Die Eingabetaste beendet den Versuch.
fact-find = Die Eingabetaste markiert die Stelle, auf die Sie drücken, und beendet den Versuch.
fact-find-size = Die Eingabetaste markiert die Stelle, auf die Sie drücken. Stellen Sie dann den Durchmesser mit den Pfeiltasten links und rechts ein und bestätigen Sie ihn mit der Eingabetaste; ± { $mm } mm gilt als richtig.
fact-hold = Halten Sie { $mn } ± { $tolerance } mN insgesamt { $s } s lang; dann endet der Versuch von selbst.
fact-touch = Berühren Sie das Ziel insgesamt { $s } s lang mit { $mn } ± { $tolerance } mN; dann endet der Versuch von selbst. Eine Berührung zählt, solange weder Spitze noch Schaft des Instruments das Organ berühren.
fact-cut = Der Versuch endet von selbst, wenn die Linie durchtrennt ist; die Eingabetaste beendet ihn vorher.
fact-time = Sie haben { $s } s Zeit.
fact-force = Eine Kraft über { $mn } mN gilt als Fehler.
fact-expert = Helle Umrisse zeigen, wie ein Experte vorging.
fact-shown = Das war die Demonstration (Skript). Mit „Beginnen“ werden neue Zahlen für Ihren Versuch gezogen.
cue-hold = halten
cue-harder = stärker ziehen
cue-less = weniger ziehen
cue-turn = entlang des Pfeils ziehen
cue-too-hard = zu stark
cue-press-harder = stärker drücken
cue-press-less = weniger drücken
cue-grasp = Rand fassen
cue-lift = anheben: Organ im Weg
cue-reach = anheben, dann Ziel berühren
cue-on-line = auf der Linie
cue-inside = { $mm } mm innerhalb der Linie
cue-outside = { $mm } mm außerhalb der Linie
cue-beside = { $mm } mm neben der Linie
diameter-title = Markiert. Wie groß ist der Knoten?
diameter-slider = Durchmesser [mm]
diameter-state = Durchmesser angeben
diameter-keys = Pfeiltasten links und rechts oder der Schieberegler

## Ergebnis
verdict-passed = Bestanden
verdict-late = Nicht bestanden: Die Zeit war abgelaufen
verdict-not-passed = Nicht bestanden: { $why }
verdict-done = Beendet
why-unmarked = Keine Stelle wurde markiert
why-no-diameter = Kein Durchmesser wurde angegeben
why-diameter = Der Durchmesser ist { $mm } mm, nicht { $stated } mm
why-far = Die Markierung liegt { $mm } mm vom Knoten entfernt
why-torn = Das Gewebe riss bei { $mn } mN
why-short = Der Zug war nur { $s } s lang richtig
why-held-torn = Das gehaltene Gewebe riss bei { $mn } mN
why-injured = Das Ziel wurde mit { $mn } mN verletzt
why-covered = Das Organ wurde nicht aus dem Weg gehalten
why-touched-short = Das Ziel wurde nur { $s } s lang berührt
why-beside = Die Spitze blieb { $mm } mm vom Ziel entfernt
why-perforated = Die Schicht, die heil bleiben soll, ist perforiert
why-off-line = Der Schnitt weicht { $mm } mm von der Linie ab
why-uncut = { $percent } % der Linie sind nicht durchtrennt
why-unknown = siehe Messwerte
good-found = Gut: Sie haben den Knoten gefunden, { $mm } mm von seiner Mitte.
good-found-size = Gut: Sie haben den Knoten gefunden, { $mm } mm von seiner Mitte, und { $stated } mm für seinen Durchmesser von { $truth } mm angegeben.
good-held = Gut: Sie haben den Zug gehalten, mit einer mittleren Abweichung von { $mn } mN.
good-touched = Gut: Sie haben das Organ aus dem Weg gehalten und das Ziel { $s } s lang berührt.
good-clear = Gut: Das Organ war Ihrem Instrument nicht im Weg.
good-cut = Gut: Die ganze Linie ist durchtrennt und die Schicht darunter unverletzt.
good-part = Gut: { $percent } % der Linie sind in voller Tiefe durchtrennt.
good-within = Gut: Der Zug war { $s } s lang richtig.
good-gentle = Gut: Sie blieben unter { $mn } mN, mit höchstens { $most } mN.
good-worked = Gut: Sie haben { $s } s lang gearbeitet.
change-mark = Verbessern: Drücken Sie, und markieren Sie mit der Eingabetaste, während Sie drücken.
change-rows = Verbessern: Drücken Sie überall gleich tief, in Reihen mit 15 mm Abstand, und vergleichen Sie die Kräfte.
change-smaller = Verbessern: Geben Sie bei einem solchen Anstieg der Kraft einen kleineren Durchmesser an.
change-larger = Verbessern: Geben Sie bei einem solchen Anstieg der Kraft über dem Knoten einen größeren Durchmesser an.
change-slower = Verbessern: Ziehen Sie langsamer: Gewebe gibt weiter nach, und ein schneller Zug schießt über das Ziel hinaus.
change-grasp = Verbessern: Fassen Sie zuerst, ziehen Sie dann, bis „halten“ angezeigt wird, und bleiben Sie dort.
change-lift-slower = Verbessern: Heben Sie langsamer und weniger weit an, und fassen Sie näher an dem, was im Weg ist.
change-come-slowly = Verbessern: Nähern Sie sich auf den letzten Millimetern langsam, und halten Sie bei der ersten Kraft an.
change-lift = Verbessern: Fassen Sie den Rand des Organs über dem Ziel und heben Sie ihn an, bis weder Spitze noch Schaft des anderen Instruments das Organ berühren.
change-stay = Verbessern: Halten Sie das Organ angehoben, und bleiben Sie auf dem Ziel, bis die Zeit um ist.
change-shallower = Verbessern: Senken Sie die Klinge weniger tief und drücken Sie nicht auf die freiliegende Schicht.
change-uncut = Verbessern: Durchtrennen Sie in voller Tiefe, was auf dem Organ noch leuchtet.
change-line = Verbessern: Bleiben Sie auf der Linie.
change-gentler =
    Verbessern: Drücken Sie sanfter: Die Kraft stieg { $count ->
        [one] einmal
       *[other] { $count }-mal
    } über { $mn } mN.
change-drops =
    Verbessern: Ziehen Sie weniger an dem, was Sie halten: Es ist { $count ->
        [one] einmal
       *[other] { $count }-mal
    } abgerutscht.
change-shaft =
    Verbessern: Halten Sie den Schaft vom Organ fern: Er hat es { $count ->
        [one] einmal
       *[other] { $count }-mal
    } berührt.
change-nothing = Verbessern: nichts; es gab keinen Fehler.
next-repeat = Weiter: Wiederholen Sie die Aufgabe mit anderen Zahlen in weniger als { $s } s und ohne Fehler.
next-retry = Weiter: Sehen Sie die Demonstration an, wenn das Vorgehen unklar ist, und versuchen Sie es erneut.
next-choose = Weiter: Wählen Sie eine Aufgabe.
result-retry = Wiederholen
result-compare = Neben der Demonstration wiedergeben
result-computing = Die Demonstration wird berechnet, { $percent } %
result-recorded-in = aufgezeichnet in { $folder }
result-not-kept = Das Ergebnis ist nicht gespeichert: { $trouble }
result-measures = Alle Messwerte
result-force = Kraft [mN] über der Zeit [s]
result-force-limit = Kraft [mN] über der Zeit [s] und ihre Grenze
result-force-band = Kraft [mN] über der Zeit [s] und ihr Bereich
result-force-most = { $plot }; höchstens { $mn } mN
result-first = Das war Ihr erster Versuch.
result-attempts = Ihre Versuche
result-now = jetzt
result-you = Sie
result-experts = Experten
result-proficient = erreicht
result-not-yet = noch nicht
measure-time-s = Zeit
measure-path-m = Weg
measure-angular-path-rad = Drehweg
measure-path-along-shaft-m = Weg entlang des Schafts
measure-economy = Bewegungsökonomie
measure-jerk = Ruck
measure-contact-time-s = Kontaktzeit
measure-peak-force-n = größte Kraft
measure-mean-force-n = mittlere Kraft
measure-force-time-n-s = Kraft-Zeit-Integral
measure-peak-grip-force-n = größte Greifkraft
measure-time-above-limit-s = Zeit über der Grenze
measure-damage-n-s = Kraft-Zeit-Integral über der Grenze
measure-force-limit-errors = Überschreitungen der Kraftgrenze
measure-perforations = Perforationen
measure-drops = Abrutschen
measure-shaft-contacts = Schaftkontakte
measure-undone-cuts = zurückgenommene Schnitte
measure-cut-length-m = Schnittlänge
measure-cut-part = geschnittener Teil der Linie
measure-cut-mean-deviation-m = mittlere Abweichung von der Linie
measure-cut-largest-deviation-m = größte Abweichung von der Linie
measure-cut-deviation-area-m2 = Fläche zwischen Schnitt und Linie
measure-beside-m = Abstand vom Ziel
measure-diameter-error-m = Fehler des Durchmessers
measure-held-s = Zeit im Bereich
measure-traction-error-n = mittlerer Fehler des Zugs

## Wiedergabe
replay-play = Abspielen
replay-stop = Anhalten
replay-leave = Verlassen
replay-time = Zeit der Sitzung
replay-at = { $at } von { $end } s
replay-own = Ihr Versuch
replay-no-scene = { $folder } enthält keine scene.toml und lässt sich deshalb nicht wiedergeben
demonstration-none = Die Aufgabe hat keine Demonstration

## Einstellungen
settings-title = Einstellungen
settings-hands = Hände
settings-mouse = Die Maus bewegt
settings-mouse-scene = das Instrument, das die Szene nennt
settings-mouse-left = das Instrument der linken Hand
settings-mouse-right = das Instrument der rechten Hand
settings-other-hand = Tasten bewegen beide Hände gleichzeitig: W A S D die linke, I J K L die rechte. Die Tabulatortaste gibt der Maus das andere Instrument.
settings-language = Sprache
settings-system = die des Systems
settings-translated = { $translated } von { $all } Texten sind in dieser Sprache; die übrigen, technische Werte und Fehlermeldungen sind englisch.
settings-display = Anzeige
settings-scale = Größe von Schrift und Schaltflächen
settings-folders = Ordner
settings-sessions = Sitzungen und Ergebnisse
settings-file = Einstellungen
settings-cached = Zwischenspeicher
settings-training-folder = Ordner für Sitzungen und Ergebnisse
settings-training-hint = leer: der Ordner des Systems
settings-set-folder = Ordner übernehmen
settings-next-start = Er gilt ab dem nächsten Start.
settings-cache = Zwischenspeicher vorbereiteter Organe
settings-cache-use =
    { $files ->
        [one] 1 Datei
       *[other] { $files } Dateien
    }, { $mb } MB
settings-clear-cache = Zwischenspeicher leeren
settings-clear-hint = Jedes Organ wird neu vorbereitet, sobald es gebraucht wird.
settings-devices = Geräte
settings-find-devices = Geräte suchen
settings-gamepad = Gamepad: { $name }
settings-no-gamepad = Gamepad: Keines ist angeschlossen, oder keines darf gelesen werden

## Lernende
class-title = Lernende
class-assignments = Zugewiesene Aufgaben
class-no-assignment = Noch ist nichts zugewiesen.
class-assigned =
    { $task }, { $cohort }: { $passes ->
        [one] einmal
       *[other] { $passes }-mal
    } bestehen bis { $due }
class-assign = Zuweisen
class-to = Gruppe oder Name
class-task = Aufgabe
class-due = Frist
class-passes = nötige bestandene Versuche
class-pin = PIN der Lehrperson, falls es eine gibt
class-given = { $task } ist { $to } zugewiesen, bis { $due }
class-nobody = Noch hat niemand eine Aufgabe versucht, und es gibt keine Gruppe: `palpate teacher cohort NAME --add TRAINEE` legt eine an.
class-learning = Lernkurven
class-no-attempt = Noch ist kein Versuch aufgezeichnet.
class-times = Zeit [s] über den Versuchen
class-trainee = Name
class-standing = Stand
class-passed = bestanden
class-attempts = Versuche
class-proficient = Niveau erreicht seit Versuch
class-each = einzelne Lernende
class-mean = Mittel der Lernenden
class-experts = Mittel der Experten

## Im Bild
picture-organ = Bild des Organs
picture-tool = { $tool }: { $mm } mm tief, { $mn } mN
picture-lump = der Knoten
picture-stated = die angegebene Größe
picture-target = das Ziel
picture-mark = Ihre Markierung
hint-touch = auf das Organ drücken: berühren, dann nach unten ziehen: tiefer · rechts ziehen: drehen · Mitte ziehen: verschieben · Rad: Zoom · ?: Tasten
hint-pulling = ziehen: Gewebe ziehen · Rad: vor und zurück · G: Branchen öffnen
hint-shut = Branchen geschlossen · ziehen: Gewebe ziehen · G: öffnen · ?: Tasten
hint-slips = nach unten ziehen: tiefer · nach oben: heraus · seitwärts: gleiten · Rad: fein · loslassen: Organ verlassen
hint-sticks = nach unten ziehen: tiefer · nach oben: heraus · seitwärts: Die Spitze haftet und nimmt das Gewebe mit · loslassen: Organ verlassen
hint-sticks-and-slides = nach unten ziehen: tiefer · nach oben: heraus · seitwärts: Die Spitze nimmt das Gewebe mit, dann gleitet sie · loslassen: Organ verlassen
hint-replay = rechts ziehen: drehen · Mitte ziehen: verschieben · Rad: Zoom · P: abspielen oder anhalten
hint-paused = Pause · P: weiter
keys-title = Tasten
keys-move = auf · links · ab · rechts
keys-shaft = hinein · heraus, entlang des Schafts
keys-roll = drehen
keys-jaws = Branchen schließen oder öffnen
keys-cut = schneiden, solange gedrückt
keys-fine = langsamer
keys-other-tool = die Maus übernimmt das andere Instrument
keys-mouse-tool = Branchen · Schnitt am Instrument der Maus
keys-drag = eindrücken; schneidend: entlang; Branchen zu: ziehen
keys-undo = Schnitt zurücknehmen
keys-pause = Pause oder weiter
keys-reset = von vorn beginnen
keys-mark = Stelle markieren oder beenden
keys-stop = Notaus: Kein Gerät gibt eine Kraft wieder
keys-engineer = technische Ansicht oder Ansicht für Lernende
keys-list = diese Liste

## Neben dem Bild
preparing-organ = Das Organ und sein Modell werden vorbereitet
preparing-force = Kraft des Gewebes über der Tiefe
preparing-reading = gespeicherte Antwort des Organs
preparing-influences = Antwort des Organs: Einflüsse
preparing-tetrahedra = Antwort des Organs: Tetraeder
preparing-factors = Antwort des Organs: Faktoren
preparing-responses = Antwort des Organs: eine Kraft auf jedes Dreieck
preparing-left = noch etwa { $seconds } s
preparing-storing = Antwort des Organs wird gespeichert
absence-way-out = Eingebauten Ösophagus öffnen
fault-thread = einer ihrer Threads ist beendet
fault-stopped = Die Simulation ist angehalten: { $why }; drücken Sie „Neu starten“
stop-emergency = NOTAUS
stop-hint = sofort keine Kraft (Leertaste); Kräfte bleiben aus, bis Sie sie wieder freigeben
stop-arm = Kräfte freigeben
stop-arm-hint = Kräfte kehren innerhalb einer halben Sekunde zurück, sobald die Hand langsam und die Kraft klein ist
warning-deep = Tiefer als 10 mm wurde hier kein Modell mit Gewebe verglichen
warning-none = keine Warnungen
warning-more = { $first } (und { $more } weitere)
panel-restart = Neu starten
panel-organ = Organ
panel-tissue = Gewebe
panel-model = Modell
panel-tool = Instrument
panel-tip = Spitze
panel-radius = Radius
panel-of-scene = das der Szene
panel-local = um die Spitze
panel-hybrid = ganzes Organ, linear
panel-nonlinear = ganzes Organ, große Verformung
panel-flat = flach
panel-ball = Kugel
panel-sticks = haftet
panel-slips = gleitet
look-plain = einfach
look-texture = Textur
look-sphere-map = Sphere-Map
look-cube-map = Cube-Map
look-orbit = von außen
look-endoscope = Endoskop
look-frame = einpassen
look-whole = das ganze Organ
look-relief = Relief
look-drop = PNG hierher ziehen: daraus entstehen die Texturen
look-maps = Texturen: { $path }
look-own = eigene
felt-scale = ein Gerät gibt die Kraft × { $scale } wieder (force_scale der Szene)
felt-force = Kraft [mN]
felt-depth = Tiefe [mm]
rates-display = Anzeige
rates-pictures = { $rate } Hz, { $samples }×, { $pixels } % der Pixel
rates-model = Modell
rates-servo = Servo
rates-of = { $rate } von { $wanted } Hz, { $priority }
priority-real-time = Echtzeitpriorität
priority-ordinary = normale Priorität
quality-late = verspätet
quality-late-hint = wie lange nach seiner Zeit ein Takt begann: p50, p99, p99,9, längste
quality-times = { $median }, { $most }, { $nearly }, { $longest } µs
quality-left-out = ausgelassen
quality-left-out-hint = Takte und Schritte, deren Zeit vorbei war; sie werden nie nachgeholt
quality-missed = { $ticks } Takte, { $steps } Schritte
quality-between = dazwischen
quality-between-hint = wie weit die Kraft zwischen den Antworten des Modells von seiner nächsten Antwort entfernt war: quadratisches Mittel, größte
quality-off = im Mittel { $mean }, höchstens { $most } mN
quality-energy = Energie
quality-energy-hint = Arbeit, welche die Regelung an der Hand geleistet hat; Gewebe nimmt nur welche auf
quality-work = { $work } mJ an die Hand
quality-limits = Grenzen
quality-limits-hint = Takte, in denen eine Kraft auf dem Weg zur Hand verändert wurde: verspätet { $late }, ausgeblendet { $faded }, gedämpft { $damped }, Wände { $walls }, gesättigt { $saturated }, thermisch begrenzt { $thermal }, im Anstieg begrenzt { $rate }; Totmannschalter { $released }-mal losgelassen
quality-forces-off = Kräfte sind aus
quality-faults = { $ticks } Takte, { $faults } Störungen
finer-none = um eine Spitze kann das globale Modell feinere Dreiecke zeigen
finer-carried = { $shown } Dreiecke werden gezeigt, eingebettet in { $solved } berechnete
finer-solved = { $solved } Dreiecke werden berechnet und gezeigt
finer-title = feiner (F2)
finer-hint = welche Dreiecke um das berührte verfeinert werden: keine, die mit gemeinsamer Kante oder die mit gemeinsamer Ecke
finer-no = nein
finer-edge = Kante
finer-vertex = Ecke
finer-levels = wie oft jedes Dreieck in vier geteilt wird
smooth-title = glatt (F3)
smooth-hint = wie Verschiebungen der Dreiecke interpoliert werden: linear oder mit diesen Funktionen
smooth-squares = kleinste Quadrate
