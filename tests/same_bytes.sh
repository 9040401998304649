# Scenes whose particles and pictures are the same bytes on every machine: sourced by qemu_test.sh and farm/aarch64.sh in a
# folder of their own. An emulated float costs about 100 real ones, so they are as small as can be.

# --- a scene for every model
mkdir models
cat >models/cubes.json <<'END_SCENE'
{"clouds":[{"cubes":[{"particles":200,"size":[2,1,2],"center":[0,0,0],"radius":0.5},
                     {"particles":200,"size":[1,2,1],"center":[2,0.3,0.1],"radius":0.3}],
            "fill":"gardner","rotate_y":33,"translate":[0.1,0.2,0.3]}]}
END_SCENE
cat >models/automaton.json <<'END_SCENE'
{"clouds":[{"model":"automaton","seed":5,"density":0.8,"automaton":{"cells":[24,12,24],"cell":3,"humidity":0.3,
    "random":{"count":6,"smallest":[4,4,4],"largest":[8,8,8]},"wind":{"ellipsoids":[{"constant":0.5}]}}}],"time":10}
END_SCENE
cat >models/spheres.json <<'END_SCENE'
{"clouds":[{"model":"spheres","spheres":{"levels":4,"size":[500,420,420]},"seed":5}],"density":0.3}
END_SCENE
cat >models/implicit.json <<'END_SCENE'
{"clouds":[{"model":"implicit","density":2,
    "implicit":{"preset":"cumulus","displacement":0.9,"noise_size":0.55,"resolution":24}}]}
END_SCENE
cat >models/formula.json <<'END_SCENE'
{"clouds":[{"model":"implicit","density":2,"implicit":{"resolution":20,"displacement":0.3,
    "bubbles":{"most":6,"knobs":2},"billows":{"waves":1},"cells":{"rings":1,"parcels":4},
    "squash":{"axis":[1,4,0],"amount":1.4},
    "formula":"a = fbm(x / 40, y / 40, z / 40, 3) + sin(x / 30); density * exp(-height) + (turb > 0.4 ? mdens ^ 1.7 : log(2 + a) / 9)"}}],
 "time":20}
END_SCENE
cat >models/ellipsoids.json <<'END_SCENE'
{"clouds":[{"model":"ellipsoids","seed":3,"ellipsoids":{"formations":[{"kind":"combined","count":8,"spread":12}],
    "texture":{"terms":7,"frequency_x":1.6,"frequency_z":1.6},"threshold":0.05,"threshold_edge":0.75,"range":0.1,
    "resolution":24}}]}
END_SCENE

# --- pictures: light that is scattered, from a sun through air, over ground
mkdir pictures
cat >pictures/noon.json <<'END_SCENE'
{"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],
 "sun":{"elevation":38,"azimuth":100,"color":"auto"},"sky":{"model":"physical","turbidity":2.6},
 "ground":{"height":-2,"albedo":[0.1,0.11,0.08]},"haze":{"extinction":0.01,"scale_height":3},
 "image":{"width":8,"height":6},"accuracy":{"rung":"transport-16"}}
END_SCENE
cat >pictures/finer.json <<'END_SCENE'
{"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],
 "image":{"width":6,"height":4},"accuracy":{"rung":"transport-24"}}
END_SCENE
cat >pictures/single.json <<'END_SCENE'
{"cubes":[{"particles":20,"size":[2,1,2],"center":[0,0,0],"radius":0.5}],"sun":{"elevation":5},
 "image":{"width":6,"height":4},"accuracy":{"rung":"single"}}
END_SCENE
# Lumps below the particles' size, droplets' fogbow, an eye within, low sun.
cat >pictures/lumps.json <<'END_SCENE'
{"cubes":[{"particles":40,"size":[3,1,2],"center":[0,0,0],"radius":0.5}],"detail":{"amount":0.8,"size":0.4},
 "sun":{"elevation":4,"azimuth":30,"color":"auto"},"sky":"physical","medium":{"phase":"mie","droplet":18},
 "image":{"width":8,"height":6},"accuracy":{"rung":"transport-16"}}
END_SCENE

# make_all FOLDER COMMAND...: all outputs of the scenes into FOLDER by COMMAND, which runs Awan on some processor.
make_all() {
    local folder=$1 scene
    shift
    mkdir "$folder"
    for scene in models/*.json; do
        "$@" particles "$scene" -o "$folder/$(basename "$scene" .json).ply" --threads 1 2>>"$folder.log"
    done
    for scene in $pictures; do
        "$@" render "pictures/$scene.json" -o "$folder/$scene.exr" --threads 1 2>>"$folder.log"
    done
}
