import bpy

polycube = bpy.context.scene.polycube
polycube.strategy = 'paper'
polycube.objective = 'AUTO'
polycube.simplicity = 1.0
polycube.steps = 400
polycube.max_distortion = 0.0
polycube.blocks_from = 'SHOWN'
