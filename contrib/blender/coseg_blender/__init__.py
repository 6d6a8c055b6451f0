"""Blender add-on: parts of coseg as materials or vertex groups, and objects as a collection for coseg."""
import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty
from mathutils import Matrix

from . import run_folder

bl_info = {
    "name": "coseg",
    "author": "coseg",
    "version": (0, 1, 0),
    "blender": (3, 0, 0),
    "location": "File > Import, File > Export",
    "description": "Imports the parts of a finished coseg run, and exports objects for coseg run",
    "category": "Import-Export",
}


def part_materials(run):
    """One material for each part, which all shapes share."""
    materials = []
    for name, color in zip(run.names, run.colors):
        material = bpy.data.materials.new(run_folder.readable(name))
        material.diffuse_color = (*(c / 255.0 for c in color), 1.0)
        materials.append(material)
    return materials


def shape_object(shape, run, mark, materials):
    """An object with its faces in the order of the file.

    Faces that Blender cannot hold are left out with their labels; the attribute coseg_face has the number that each face
    has in the file and in its labels, from 0.
    """
    kept = run_folder.faces_that_blender_holds(shape.faces)
    faces, parts = [shape.faces[k] for k in kept], [shape.parts[k] for k in kept]
    name = run_folder.readable(shape.name)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(shape.vertices, [], faces)
    mesh.attributes.new("coseg_face", "INT", "FACE").data.foreach_set("value", kept)
    obj = bpy.data.objects.new(name, mesh)
    if mark == "MATERIALS":
        for material in materials:
            mesh.materials.append(material)
        mesh.polygons.foreach_set("material_index", parts)
    else:
        for part, part_name in enumerate(run.names):
            corners = {corner for face, own in zip(faces, parts) if own == part for corner in face}
            obj.vertex_groups.new(name=run_folder.readable(part_name)).add(sorted(corners), 1.0, "REPLACE")
    mesh.update()
    return obj


def import_run(context, folder, mark="MATERIALS", align=True, scale=True):
    """Objects of all shapes in a collection of their own, side by side. Raises RunError."""
    run = run_folder.read_run(folder)
    materials = part_materials(run) if mark == "MATERIALS" else []
    collection = bpy.data.collections.new("coseg")
    context.scene.collection.children.link(collection)
    objects = [shape_object(shape, run, mark, materials) for shape in run.shapes]
    rotations = [shape.rotation if align else run_folder.IDENTITY for shape in run.shapes]
    boxes = [run_folder.bounds(shape.vertices, shape.faces, turn) for shape, turn in zip(run.shapes, rotations)]
    for obj, turn, (size, place) in zip(objects, rotations, run_folder.side_by_side(boxes, scale)):
        obj.matrix_world = Matrix.Translation(place) @ Matrix.Scale(size, 4) @ Matrix(turn).to_4x4()
        collection.objects.link(obj)
    return objects


def export_objects(context, folder, objects):
    """Mesh objects, with modifiers and transforms applied, as OFF files; their paths. Raises RunError."""
    graph = context.evaluated_depsgraph_get()
    meshes = []
    for obj in objects:
        if obj.type != "MESH":
            continue
        evaluated = obj.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        vertices = [tuple(obj.matrix_world @ vertex.co) for vertex in mesh.vertices]
        meshes.append((obj.name, vertices, [tuple(polygon.vertices) for polygon in mesh.polygons]))
        evaluated.to_mesh_clear()
    return run_folder.write_collection(folder, meshes)


class ImportRun(bpy.types.Operator):
    """Import the shapes of a finished coseg run with their parts"""
    bl_idname = "import_scene.coseg_run"
    bl_label = "coseg run (folder)"
    bl_options = {"REGISTER", "UNDO"}

    directory: StringProperty(subtype="DIR_PATH")
    mark: EnumProperty(name="Parts as", items=(("MATERIALS", "Materials", ""), ("GROUPS", "Vertex groups", "")))
    align: BoolProperty(name="Standing alike", default=True, description="Turn the shapes as the run aligned them")
    scale: BoolProperty(name="Of one size", default=True)

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            objects = import_run(context, self.directory, self.mark, self.align, self.scale)
        except run_folder.RunError as error:
            self.report({"ERROR"}, run_folder.readable(str(error)))
            return {"CANCELLED"}
        self.report({"INFO"}, f"{len(objects)} shapes")
        return {"FINISHED"}


class ExportCollection(bpy.types.Operator):
    """Export the selected objects as a folder of meshes for coseg run"""
    bl_idname = "export_scene.coseg_collection"
    bl_label = "coseg collection (folder)"

    directory: StringProperty(subtype="DIR_PATH")
    parts: IntProperty(name="Parts", default=4, min=1, max=1000, description="Of the command that is shown")

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            export_objects(context, self.directory, context.selected_objects)
        except (OSError, run_folder.RunError) as error:
            self.report({"ERROR"}, run_folder.readable(str(error)))
            return {"CANCELLED"}
        self.report({"INFO"}, run_folder.run_command(self.directory, self.parts))
        return {"FINISHED"}


def import_entry(self, _context):
    self.layout.operator(ImportRun.bl_idname)


def export_entry(self, _context):
    self.layout.operator(ExportCollection.bl_idname)


def register():
    bpy.utils.register_class(ImportRun)
    bpy.utils.register_class(ExportCollection)
    bpy.types.TOPBAR_MT_file_import.append(import_entry)
    bpy.types.TOPBAR_MT_file_export.append(export_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(export_entry)
    bpy.types.TOPBAR_MT_file_import.remove(import_entry)
    bpy.utils.unregister_class(ExportCollection)
    bpy.utils.unregister_class(ImportRun)
