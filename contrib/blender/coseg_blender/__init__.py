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
        material = bpy.data.materials.new(name)
        material.diffuse_color = (*(c / 255.0 for c in color), 1.0)
        materials.append(material)
    return materials


def shape_object(shape, run, mark, materials):
    """An object with its faces in the order of the file."""
    mesh = bpy.data.meshes.new(shape.name)
    mesh.from_pydata(shape.vertices, [], shape.faces)
    obj = bpy.data.objects.new(shape.name, mesh)
    if mark == "MATERIALS":
        for material in materials:
            mesh.materials.append(material)
        mesh.polygons.foreach_set("material_index", shape.parts)
    else:
        for part, name in enumerate(run.names):
            corners = {corner for face, own in zip(shape.faces, shape.parts) if own == part for corner in face}
            obj.vertex_groups.new(name=name).add(sorted(corners), 1.0, "REPLACE")
    mesh.update()
    return obj


def import_run(context, folder, mark="MATERIALS", align=True, scale=True):
    """Objects of all shapes in a collection of their own, side by side. Raises RunError."""
    run = run_folder.read_run(folder)
    materials = part_materials(run) if mark == "MATERIALS" else []
    collection = bpy.data.collections.new("coseg")
    context.scene.collection.children.link(collection)
    objects = [shape_object(shape, run, mark, materials) for shape in run.shapes]
    sizes = [max(max(obj.dimensions), 1e-12) for obj in objects]
    largest = 1.0 if scale else max(sizes)
    for obj, shape, size, (x, y) in zip(objects, run.shapes, sizes, run_folder.grid_places([largest] * len(objects))):
        turn = Matrix(shape.rotation).to_4x4() if align else Matrix.Identity(4)
        enlarged = Matrix.Scale(1.0 / size if scale else 1.0, 4)
        obj.matrix_world = Matrix.Translation((x, y, 0.0)) @ enlarged @ turn
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
            self.report({"ERROR"}, str(error))
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
            self.report({"ERROR"}, str(error))
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
