import bpy

polycube = bpy.context.scene.polycube
polycube.strategy = 'best'
polycube.objective = 'AUTO'
polycube.simplicity = 0.5
polycube.steps = 400
polycube.max_distortion = 0.0
polycube.blocks_from = 'SHOWN'
