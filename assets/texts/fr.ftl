# Les textes du simulateur en français. Clés et variables sont celles de en.ftl.

## Sur plusieurs pages
common-back = Retour
common-tasks = Exercices
common-replay = Revoir
common-free-play = Exploration libre
common-untitled = Exercice sans titre
common-demonstration = démonstration (script)
common-passed = réussi
common-not-passed = non réussi
common-or-key = ou { $key }
common-time-errors =
    { $s } s, { $errors ->
        [one] { $errors } erreur
       *[other] { $errors } erreurs
    }
hand-left = gauche
hand-right = droite
key-enter = Entrée
key-shift = Maj
key-tab = Tab
key-backspace = Retour arrière
key-space = Espace
key-esc = Échap
key-drag = glisser

## Exercices
task-palpation = Palpation
task-palpation-what = Un nodule se trouve sous la face antérieure de ce foie, chaque fois à un autre endroit. Appuyez çà et là, toujours à la même profondeur : au-dessus du nodule, la force est plus grande. Appuyez dessus et marquez-le avec Entrée. Indiquez ensuite son diamètre, entre 13 et 21 mm : plus le nodule est grand, plus la force au-dessus de lui est grande par rapport à la force à côté.
task-traction = Traction
task-traction-what = Saisissez l’œsophage de la main gauche et tirez-le dans le sens de la flèche, jusqu’à ce que la force soit dans sa plage. Maintenez-la. La force et la direction changent à chaque tentative. Une traction supérieure à 0,6 N déchire le tissu.
task-myotomy = Myotomie
task-myotomy-what = Tenez l’œsophage à côté de la ligne avec la main gauche. De la main droite, sectionnez sa musculeuse le long de la ligne : d’abord la couche externe, longitudinale (0,7 mm de profondeur), puis, dans son ouverture, la couche circulaire (1,5 mm). Respectez la muqueuse : une lame à 2,3 mm de profondeur ou un appui de plus de 0,5 N la perfore. Ce qui reste à sectionner brille.
task-retraction = Rétraction
task-retraction-what = Le lobe gauche de ce foie recouvre un point de l’estomac, la cible : un anneau en pointillé montre où elle se trouve, un anneau plein que vous la voyez. Saisissez de la main gauche le bord du lobe au-dessus d’elle et soulevez-le. Touchez ensuite la cible de la main droite, doucement, et restez-y. Une traction de plus de 1,2 N déchire le foie, et plus de 0,5 N sur l’estomac le lèse.
task-cutting = Découpe de précision
task-cutting-what = Un cercle est tracé sur cette plaque à deux couches, chaque fois à un autre endroit et d’une autre taille. Tenez la plaque à l’extérieur du cercle avec la main gauche. De la main droite, coupez la couche supérieure le long de la ligne, sur tout le tour : à au moins 1,5 mm de profondeur, et à moins de 4 mm, où la couche inférieure est traversée. Aucune partie de la coupe ne doit être à plus de 2 mm de la ligne. Ce qui reste à couper brille.

## Accueil
home-subtitle = Palper des organes simulés et s’entraîner à des gestes chirurgicaux
home-you = Vous
home-name = Nom
home-name-hint = Vos résultats sont enregistrés sous ce nom.
home-sessions-in = Les séances sont enregistrées dans { $folder }
home-no-results = Pas encore de résultats.
home-free-hint = Palpez, tenez, tirez et coupez à votre guise. Rien n’est enregistré.
home-open = Ouvrir
home-open-task = Ouvrir { $task }
home-tried =
    { $count ->
        [one] { $count } tentative
       *[other] { $count } tentatives
    }, dont { $passed ->
        [one] { $passed } réussie
       *[other] { $passed } réussies
    } ; la dernière a duré { $s } s
home-learning = { $task } : temps [s] selon les tentatives
home-replay-session = Revoir { $task }, { $date }
home-assigned = { $task } : à réussir { $passes } fois d’ici au { $due } ; { $passed } fois jusqu’ici
home-limits = Ce que ce programme ne fait pas : il n’y a ni saignement, ni fumée, ni suture ; les organes voisins arrêtent la pointe des instruments et un organe qui se déforme, mais pas les tiges ; une souris ne restitue aucune force. Ce n’est pas un dispositif médical certifié, et aucune étude n’a montré qu’un score obtenu ici en prédise un au bloc opératoire.
standing-done = fait
standing-open = à faire
standing-late = en retard

## Tentative
attempt-begin = Commencer
attempt-begin-ready = Commencer dès que possible
attempt-watch = Voir la démonstration (script)
attempt-preparing = préparation de l’organe, { $percent } %
attempt-preparing-begins = préparation de l’organe, { $percent } % ; la tentative commence ensuite
attempt-recorded = enregistrement
attempt-not-recorded = NON ENREGISTRÉ
attempt-time = { $s } s
attempt-time-left = encore { $s } s
attempt-end = Terminer
attempt-part = part de l’exercice accomplie
attempt-gauge = Force { $mn } mN ; elle doit être entre { $low } et { $high } mN
attempt-perforated =
    { $count ->
        [one] { $count } perforation
       *[other] { $count } perforations
    }
attempt-elsewhere = La séance est en mémoire, au moins ses 20 premières minutes. L’enregistrer en entier dans un autre dossier :
attempt-record-there = Enregistrer là
attempt-no-expert = sans comparaison avec un expert : { $error }
attempt-scene-changed = non enregistré : la scène a été modifiée dans cette fenêtre, un enregistrement ne pourrait pas être revu
attempt-unrecorded = non enregistré : { $error }
fact-free = Entrée met fin à la tentative.
fact-find = Entrée marque l’endroit où vous appuyez et met fin à la tentative.
fact-find-size = Entrée marque l’endroit où vous appuyez. Réglez ensuite le diamètre avec les flèches gauche et droite et validez-le avec Entrée ; ± { $mm } mm est accepté.
fact-hold = Maintenez { $mn } ± { $tolerance } mN pendant { $s } s en tout ; la tentative se termine alors d’elle-même.
fact-touch = Touchez la cible avec { $mn } ± { $tolerance } mN pendant { $s } s en tout ; la tentative se termine alors d’elle-même. Un contact compte tant que ni la pointe ni la tige de l’instrument ne touchent l’organe.
fact-cut = La tentative se termine d’elle-même quand la ligne est sectionnée ; Entrée y met fin avant.
fact-time = Vous avez { $s } s.
fact-force = Une force supérieure à { $mn } mN compte comme une erreur.
fact-expert = Des contours clairs montrent le geste d’un expert.
fact-shown = C’était la démonstration (script). « Commencer » tire de nouveaux nombres pour votre tentative.
cue-hold = maintenir
cue-harder = tirer plus fort
cue-less = tirer moins fort
cue-turn = tirer selon la flèche
cue-too-hard = trop fort
cue-press-harder = appuyer plus fort
cue-press-less = appuyer moins fort
cue-grasp = saisir le bord
cue-lift = soulever : organe gênant
cue-reach = soulever, puis toucher la cible
cue-on-line = sur la ligne
cue-inside = { $mm } mm à l’intérieur de la ligne
cue-outside = { $mm } mm à l’extérieur de la ligne
cue-beside = { $mm } mm à côté de la ligne
diameter-title = Marqué. Quelle est la taille du nodule ?
diameter-slider = Diamètre [mm]
diameter-state = Indiquer le diamètre
diameter-keys = flèches gauche et droite, ou le curseur

## Résultat
verdict-passed = Réussi
verdict-late = Non réussi : le temps était écoulé
verdict-not-passed = Non réussi : { $why }
verdict-done = Terminé
why-unmarked = aucun endroit n’a été marqué
why-no-diameter = aucun diamètre n’a été indiqué
why-diameter = le diamètre est de { $mm } mm, et non de { $stated } mm
why-far = la marque est à { $mm } mm du nodule
why-torn = le tissu s’est déchiré à { $mn } mN
why-short = la traction n’a été correcte que pendant { $s } s
why-held-torn = le tissu tenu s’est déchiré à { $mn } mN
why-injured = la cible a été lésée par { $mn } mN
why-covered = l’organe n’a pas été écarté
why-touched-short = la cible n’a été touchée que pendant { $s } s
why-beside = la pointe est restée à { $mm } mm de la cible
why-perforated = la couche à préserver est perforée
why-off-line = la section s’écarte de { $mm } mm de la ligne
why-uncut = { $percent } % de la ligne ne sont pas sectionnés
why-unknown = voir les mesures
good-found = Bien : vous avez trouvé le nodule, à { $mm } mm de son centre.
good-found-size = Bien : vous avez trouvé le nodule, à { $mm } mm de son centre, et indiqué { $stated } mm pour son diamètre de { $truth } mm.
good-held = Bien : vous avez maintenu la traction, avec un écart moyen de { $mn } mN.
good-touched = Bien : vous avez écarté l’organe et touché la cible pendant { $s } s.
good-clear = Bien : l’organe ne gênait pas votre instrument.
good-cut = Bien : toute la ligne est sectionnée et la couche en dessous est intacte.
good-part = Bien : { $percent } % de la ligne sont sectionnés sur toute leur profondeur.
good-within = Bien : la traction a été correcte pendant { $s } s.
good-gentle = Bien : vous n’avez pas dépassé { $mn } mN ; maximum { $most } mN.
good-worked = Bien : vous avez travaillé pendant { $s } s.
change-mark = À corriger : appuyez, et marquez avec Entrée pendant que vous appuyez.
change-rows = À corriger : appuyez partout à la même profondeur, en rangées espacées de 15 mm, et comparez les forces.
change-smaller = À corriger : pour une telle hausse de la force, indiquez un diamètre plus petit.
change-larger = À corriger : pour une telle hausse de la force au-dessus du nodule, indiquez un diamètre plus grand.
change-slower = À corriger : tirez plus lentement ; le tissu continue de céder, et une traction rapide dépasse la cible.
change-grasp = À corriger : saisissez d’abord, tirez ensuite jusqu’à l’indication « maintenir », et restez-y.
change-lift-slower = À corriger : soulevez plus lentement et moins loin, et saisissez plus près de ce qui gêne.
change-come-slowly = À corriger : approchez lentement sur les derniers millimètres, et arrêtez-vous à la première force.
change-lift = À corriger : saisissez le bord de l’organe au-dessus de la cible et soulevez-le jusqu’à ce que ni la pointe ni la tige de l’autre instrument ne touchent l’organe.
change-stay = À corriger : gardez l’organe soulevé, et restez sur la cible jusqu’à la fin du temps.
change-shallower = À corriger : abaissez moins la lame et n’appuyez pas sur la couche exposée.
change-uncut = À corriger : sectionnez sur toute leur profondeur les parties qui brillent encore sur l’organe.
change-line = À corriger : restez sur la ligne.
change-gentler = À corriger : appuyez plus doucement ; la force a dépassé { $mn } mN { $count } fois.
change-drops =
    À corriger : tirez moins fort sur ce que vous tenez ; la prise a glissé { $count } fois.
change-shaft = À corriger : éloignez la tige de l’organe ; elle l’a touché { $count } fois.
change-nothing = À corriger : rien ; il n’y a pas eu d’erreur.
next-repeat = Ensuite : recommencez avec d’autres nombres, en moins de { $s } s et sans erreur.
next-retry = Ensuite : regardez la démonstration si la démarche n’est pas claire, puis réessayez.
next-choose = Ensuite : choisissez un exercice.
result-retry = Recommencer
result-compare = Revoir à côté de la démonstration
result-computing = calcul de la démonstration, { $percent } %
result-recorded-in = enregistré dans { $folder }
result-not-kept = le résultat n’est pas enregistré : { $trouble }
result-measures = Toutes les mesures
result-force = Force [mN] en fonction du temps [s]
result-force-limit = Force [mN] en fonction du temps [s], et sa limite
result-force-band = Force [mN] en fonction du temps [s], et sa plage
result-force-most = { $plot } ; { $mn } mN au plus
result-first = C’était votre première tentative.
result-attempts = Vos tentatives
result-now = maintenant
result-you = vous
result-experts = experts
result-proficient = atteint
result-not-yet = pas encore
measure-time-s = temps
measure-path-m = trajet
measure-angular-path-rad = trajet angulaire
measure-path-along-shaft-m = trajet selon la tige
measure-economy = économie de mouvement
measure-jerk = à-coups
measure-contact-time-s = temps de contact
measure-peak-force-n = force maximale
measure-mean-force-n = force moyenne
measure-force-time-n-s = intégrale de la force
measure-peak-grip-force-n = force de préhension maximale
measure-time-above-limit-s = temps au-dessus de la limite
measure-damage-n-s = intégrale de la force au-dessus de la limite
measure-force-limit-errors = dépassements de la limite de force
measure-perforations = perforations
measure-drops = prises perdues
measure-shaft-contacts = contacts de la tige
measure-undone-cuts = coupes annulées
measure-cut-length-m = longueur de la section
measure-cut-part = partie coupée de la ligne
measure-cut-mean-deviation-m = écart moyen à la ligne
measure-cut-largest-deviation-m = écart maximal à la ligne
measure-cut-deviation-area-m2 = surface entre la coupe et la ligne
measure-beside-m = distance à la cible
measure-diameter-error-m = erreur sur le diamètre
measure-held-s = temps dans la plage
measure-traction-error-n = écart moyen de la traction

## Revoir une séance
replay-play = Lire
replay-stop = Arrêter
replay-leave = Quitter
replay-time = Temps de la séance
replay-at = { $at } sur { $end } s
replay-own = votre tentative
replay-no-scene = { $folder } ne contient pas de scene.toml et ne peut donc pas être revu
demonstration-none = l’exercice n’a pas de démonstration

## Réglages
settings-title = Réglages
settings-hands = Mains
settings-mouse = La souris déplace
settings-mouse-scene = l’instrument que la scène désigne
settings-mouse-left = l’instrument de la main gauche
settings-mouse-right = l’instrument de la main droite
settings-other-hand = Les touches déplacent les deux mains à la fois : W A S D la gauche, I J K L la droite. Tab donne l’autre instrument à la souris.
settings-language = Langue
settings-system = celle du système
settings-translated = { $translated } textes sur { $all } sont dans cette langue ; les autres, les valeurs techniques et les messages d’erreur sont en anglais.
settings-display = Affichage
settings-scale = Taille des textes et des boutons
settings-folders = Dossiers
settings-sessions = Séances et résultats
settings-file = Réglages
settings-cached = Cache
settings-training-folder = Dossier des séances et des résultats
settings-training-hint = vide : le dossier du système
settings-set-folder = Choisir ce dossier
settings-next-start = Il sera utilisé au prochain démarrage.
settings-cache = Cache des organes préparés
settings-cache-use =
    { $files ->
        [one] { $files } fichier
       *[other] { $files } fichiers
    }, { $mb } Mo
settings-clear-cache = Vider le cache
settings-clear-hint = Chaque organe sera préparé de nouveau quand il servira.
settings-devices = Périphériques
settings-find-devices = Chercher les périphériques
settings-gamepad = Manette : { $name }
settings-no-gamepad = Manette : aucune n’est branchée, ou aucune ne peut être lue

## Apprenants
class-title = Apprenants
class-assignments = Exercices attribués
class-no-assignment = Rien n’est encore attribué.
class-assigned = { $task }, { $cohort } : à réussir { $passes } fois d’ici au { $due }
class-assign = Attribuer
class-to = groupe ou apprenant
class-task = exercice
class-due = échéance
class-passes = tentatives réussies exigées
class-pin = code PIN de l’enseignant, s’il y en a un
class-given = { $task } est attribué à { $to }, d’ici au { $due }
class-nobody = Personne n’a encore tenté d’exercice, et il n’y a aucun groupe : `palpate teacher cohort NAME --add TRAINEE` en crée un.
class-learning = Courbes d’apprentissage
class-no-attempt = Aucune tentative n’est encore enregistrée.
class-times = Temps [s] selon les tentatives
class-trainee = nom
class-standing = état
class-passed = réussies
class-attempts = tentatives
class-proficient = niveau atteint depuis la tentative
class-each = chaque apprenant
class-mean = moyenne des apprenants
class-experts = moyenne des experts

## Dans l’image
picture-organ = Image de l’organe
picture-tool = { $tool } : { $mm } mm de profondeur, { $mn } mN
picture-lump = le nodule
picture-stated = la taille indiquée
picture-target = la cible
picture-mark = votre marque
hint-touch = appuyer sur l’organe : toucher, puis glisser vers le bas : plus profond · bouton droit : tourner · bouton du milieu : déplacer · molette : zoom · ? : touches
hint-pulling = glisser : tirer · molette : avancer, reculer · G : ouvrir les mors
hint-shut = les mors sont fermés · glisser : tirer · G : les ouvrir · ? : touches
hint-slips = vers le bas : plus profond · vers le haut : sortir · de côté : glisser · molette : fin · relâcher : quitter l’organe
hint-sticks = vers le bas : plus profond · vers le haut : sortir · de côté : la pointe adhère et entraîne le tissu · relâcher : quitter l’organe
hint-sticks-and-slides = vers le bas : plus profond · vers le haut : sortir · de côté : la pointe entraîne le tissu, puis glisse · relâcher : quitter l’organe
hint-replay = bouton droit : tourner · bouton du milieu : déplacer · molette : zoom · P : lire ou arrêter
hint-paused = pause · P : continuer
keys-title = touches
keys-move = haut · gauche · bas · droite
keys-shaft = avancer · reculer, selon la tige
keys-roll = tourner
keys-jaws = fermer ou ouvrir les mors
keys-cut = couper, touche enfoncée
keys-fine = plus lentement
keys-other-tool = la souris prend l’autre instrument
keys-mouse-tool = mors · coupe de l’instrument de la souris
keys-drag = enfoncer ; en coupant : suivre ; mors fermés : tirer
keys-undo = annuler une coupe
keys-pause = pause ou continuer
keys-reset = recommencer
keys-mark = marquer l’endroit, ou terminer
keys-stop = arrêt d’urgence : aucun périphérique ne restitue de force
keys-engineer = vue technique, ou vue de l’apprenant
keys-list = cette liste

## À côté de l’image
preparing-organ = préparation de l’organe et de son modèle
preparing-force = force du tissu selon la profondeur
preparing-reading = réponse enregistrée de l’organe
preparing-influences = réponse de l’organe : influences
preparing-tetrahedra = réponse de l’organe : tétraèdres
preparing-factors = réponse de l’organe : facteurs
preparing-responses = réponse de l’organe : une force sur chaque triangle
preparing-left = encore { $seconds } s environ
preparing-storing = enregistrement de la réponse de l’organe
absence-way-out = Ouvrir l’œsophage intégré
fault-thread = un de ses fils d’exécution s’est terminé
fault-stopped = la simulation s’est arrêtée : { $why } ; appuyez sur « Redémarrer »
stop-emergency = ARRÊT D’URGENCE
stop-hint = aucune force, immédiatement (barre d’espace) ; les forces restent coupées jusqu’à leur réactivation
stop-arm = Réactiver les forces
stop-arm-hint = les forces reviennent en une demi-seconde, dès que la main est lente et la force faible
warning-deep = au-delà de 10 mm de profondeur, aucun modèle n’a été comparé ici à du tissu
warning-none = aucun avertissement
warning-more = { $first } (et { $more } autres)
panel-restart = Redémarrer
panel-organ = organe
panel-tissue = tissu
panel-model = modèle
panel-tool = instrument
panel-tip = pointe
panel-radius = rayon
panel-of-scene = celui de la scène
panel-local = autour de la pointe
panel-hybrid = organe entier, linéaire
panel-nonlinear = organe entier, grande déformation
panel-flat = plate
panel-ball = bille
panel-sticks = adhère
panel-slips = glisse
look-plain = simple
look-texture = texture
look-sphere-map = sphere map
look-cube-map = cube map
look-orbit = orbite
look-endoscope = endoscope
look-frame = cadrer
look-whole = l’organe entier
look-relief = relief
look-drop = déposez un PNG ici : les textures en sont faites
look-maps = textures : { $path }
look-own = intégrées
felt-scale = un périphérique restitue la force × { $scale } (force_scale de la scène)
felt-force = force [mN]
felt-depth = profondeur [mm]
rates-display = affichage
rates-pictures = { $rate } Hz, { $samples }×, { $pixels } % des pixels
rates-model = modèle
rates-servo = asservissement
rates-of = { $rate } sur { $wanted } Hz, { $priority }
priority-real-time = priorité temps réel
priority-ordinary = priorité ordinaire
quality-late = retard
quality-late-hint = combien de temps après son heure un cycle a commencé : p50, p99, p99,9, le plus long
quality-times = { $median }, { $most }, { $nearly }, { $longest } µs
quality-left-out = omis
quality-left-out-hint = cycles et pas dont l’heure était passée ; ils ne sont jamais rattrapés
quality-missed = { $ticks } cycles, { $steps } pas
quality-between = entre-temps
quality-between-hint = écart entre la force restituée entre les réponses du modèle et la réponse suivante : moyenne quadratique, maximum
quality-off = écart { $mean }, au plus { $most } mN
quality-energy = énergie
quality-energy-hint = travail fourni à la main par la boucle ; le tissu ne fait qu’en absorber
quality-work = { $work } mJ vers la main
quality-limits = limites
quality-limits-hint = cycles où une force a été modifiée avant d’atteindre la main : en retard { $late }, atténuée { $faded }, amortie { $damped }, parois { $walls }, saturée { $saturated }, limite thermique { $thermal }, limite de variation { $rate } ; interrupteur d’homme mort relâché { $released } fois
quality-forces-off = les forces sont coupées
quality-faults = { $ticks } cycles, { $faults } défauts
finer-none = autour d’une pointe, le modèle global peut montrer des triangles plus fins
finer-carried = { $shown } triangles affichés, intégrés dans { $solved } triangles calculés
finer-solved = { $solved } triangles calculés et affichés
finer-title = plus fin (F2)
finer-hint = quels triangles autour du triangle touché sont raffinés : aucun, ceux qui partagent une arête ou ceux qui partagent un sommet
finer-no = non
finer-edge = arête
finer-vertex = sommet
finer-levels = combien de fois chaque triangle est divisé en quatre
smooth-title = lisse (F3)
smooth-hint = comment les déplacements des triangles sont interpolés : linéairement ou par ces fonctions
smooth-squares = moindres carrés
