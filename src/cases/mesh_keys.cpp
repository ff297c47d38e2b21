/// Keys of [mesh]: files, built-in shapes, groups, sizes, mould and layers.
#include "cases/case_keys.hpp"
#include "cases/feeder_keys.hpp"

namespace solidus::cases {

namespace {

/// Keys of the built-in shape of a cylinder in its mould.
Section<CylinderInMouldSpec> cylinder_in_mould_keys() {
  Section<CylinderInMouldSpec> s("cylinder_in_mould",
                                 "A cylinder cast in an open cylindrical mould, for axisymmetric analyses: "
                                 "the axis is x = 0, the casting's bottom y = 0.");
  s.quantity("radius", &CylinderInMouldSpec::radius, "m").positive().doc("Radius of the casting.");
  s.quantity("height", &CylinderInMouldSpec::height, "m").positive().doc("Height of the casting.");
  s.quantity("mould_wall", &CylinderInMouldSpec::mould_wall, "m")
      .positive()
      .doc("Thickness of the mould's wall.");
  s.quantity("mould_bottom", &CylinderInMouldSpec::mould_bottom, "m")
      .positive()
      .doc("Thickness of the mould's bottom.");
  s.quantity("mould_height", &CylinderInMouldSpec::mould_height, "m")
      .positive()
      .doc("Height of the mould, bottom included; at least bottom and casting.");
  s.quantity("element_size", &CylinderInMouldSpec::element_size, "m")
      .positive()
      .doc("Element size in the casting.");
  s.quantity("mould_element_size", &CylinderInMouldSpec::mould_element_size, "m")
      .positive()
      .doc("Element size in the mould.");
  s.key("interface_ratio", &CylinderInMouldSpec::interface_ratio)
      .initially(1.0)
      .range(0.1, 10)
      .doc(
          "Elements of the mould per element of the casting along the interface; other than one, the meshes "
          "do not match.");
  return s;
}

/// Keys of the built-in block.
Section<BlockSpec> block_keys() {
  Section<BlockSpec> s(
      "block",
      "A rectangle, or in a solid analysis a box, of one body 'block' with sides 'x_min', 'x_max', ...");
  s.quantity("size", &BlockSpec::size, "m").positive().doc("Lengths along the axes, two or three.");
  s.quantity("origin", &BlockSpec::origin, "m")
      .initially(Value::list())
      .doc("Corner with the smallest coordinates; empty: zero.");
  s.key("divisions", &BlockSpec::divisions).range(1, 100000).doc("Number of elements along the axes.");
  return s;
}

/// Keys of two built-in blocks, one above the other.
Section<TwoBlocksSpec> two_blocks_keys() {
  using T = TwoBlocksSpec;
  Section<T> s(
      "two_blocks",
      "Two rectangles or boxes, the body 'upper' above the body 'lower', with meshes that need not match. "
      "Surfaces: "
      "'lower_top' and 'upper_bottom' face each other; the others are 'lower_x_min', 'upper_x_max', ...");
  s.quantity("lower", &T::lower, "m")
      .positive()
      .doc("Lengths of the lower one along the axes, two or three.");
  s.quantity("upper", &T::upper, "m").positive().doc("Lengths of the upper one.");
  s.key("lower_divisions", &T::lower_divisions)
      .range(1, 100000)
      .doc("Number of elements along the axes, lower one.");
  s.key("upper_divisions", &T::upper_divisions)
      .range(1, 100000)
      .doc("Number of elements along the axes, upper one.");
  s.quantity("gap", &T::gap, "m").initially("0 m").at_least(0).doc("Distance between them.");
  return s;
}

/// Keys of a constant that a .geo script is given.
Section<MeshConstantSpec> constant_keys() {
  Section<MeshConstantSpec> s("constant",
                              "A constant of a .geo script, which declares it as `DefineConstant[ size = {8, "
                              "Name \"size\"} ];`: the value given here replaces the one in the script.");
  s.key("name", &MeshConstantSpec::name).doc("The constant's name in the script.");
  s.key("value", &MeshConstantSpec::value).doc("Its value, in the script's units.");
  return s;
}

/// Keys of a group of the mesh. The ways to choose it exclude each other, which check_mesh() says.
Section<MeshGroupSpec> group_keys() {
  using G = MeshGroupSpec;
  Section<G> s(
      "group",
      "A name for volumes or surfaces of a geometry file (STEP, BREP, IGES, .geo), chosen by numbers, by "
      "label, or by a box that they lie in; or for faces of any mesh, chosen by the rules `owner`, `normal`, "
      "`plane`, `nearest` and the box; a face must obey all rules that are given. `solidus mesh-info` lists "
      "them.");
  s.key("name", &G::name).doc("The name of the group, for bodies, conditions, contact.");
  s.choice("kind", &G::kind,
           {{"body", G::Kind::body, "volumes; of a plane geometry its surfaces"},
            {"surface", G::Kind::surface, "surfaces; of a plane geometry its lines"}})
      .initially("surface")
      .doc("What is chosen.");
  s.key("numbers", &G::numbers)
      .initially(Value::list())
      .range(1, 1000000000)
      .doc("Numbers in the file: 3 is what is called surface_3 without a group.");
  s.key("label", &G::label)
      .initially("")
      .doc("The name that the file gives them, whole or behind its last slash.");
  s.quantity("lowest", &G::lowest, "m")
      .initially(Value::list())
      .doc("Three coordinates: the corner of a box where they are smallest.");
  s.quantity("highest", &G::highest, "m").initially(Value::list()).doc("The corner where they are largest.");
  s.key("owner", &G::owner)
      .initially("")
      .doc("A rule for faces: those on the outer surface of this body (its group).");
  s.key("normal", &G::normal)
      .initially(Value::list())
      .doc("A rule for faces: those whose outward normal has this direction (a vector of any length).");
  s.quantity("angle", &G::angle, "rad")
      .initially("10 degree")
      .range(0, 3.15)
      .doc("By how much their normal may differ from `normal`.");
  s.quantity("plane", &G::plane, "m")
      .initially(Value::list())
      .doc("A rule for faces, with `normal`: those in the plane through this point.");
  s.quantity("nearest", &G::nearest, "m")
      .initially(Value::list())
      .doc(
          "A rule for faces: those of the smooth part of an outer surface (bounded by edges of more than 30 "
          "degrees) that comes nearest to this point.");
  s.place(&G::where);
  return s;
}

/// Keys of the size of elements in a body that is meshed by the thickness of its walls.
Section<MeshSizeSpec> size_keys() {
  using S = MeshSizeSpec;
  Section<S> s(
      "size",
      "How large the elements of a body are where the file holds a geometry: solids (STEP, BREP, IGES), the "
      "surface of one (STL), or a mesh, of which the outer surfaces of the bodies are taken. With any of "
      "these sections "
      "sizes follow the thickness of walls and grow away from thin ones, bodies that touch are meshed "
      "together, and the settings of the mesh generator are varied until the smallest quality of an element "
      "is above 0.15.");
  s.key("body", &S::body).doc("The group of the mesh.");
  s.quantity("size", &S::size, "m").positive().doc("The largest size.");
  s.quantity("smallest", &S::smallest, "m")
      .positive()
      .doc("The smallest size, in thin walls; without it a quarter of `size`.");
  s.key("across", &S::across)
      .initially(2.0)
      .range(0, 20)
      .doc("Approximate number of elements through the thickness of a wall; 0: thickness does not count.");
  s.key("growth", &S::growth)
      .initially(0.4)
      .range(0.05, 2)
      .doc("Increase of the element size per length, away from smaller elements.");
  s.place(&S::where);
  return s;
}

/// Keys of a mould that is made around a casting.
Section<MouldBlockSpec> mould_keys() {
  using M = MouldBlockSpec;
  Section<M> s("mould", "A block of mould around everything that the geometry holds.");
  s.key("name", &M::name).initially("mould").doc("Its name, as a group of the mesh.");
  s.quantity("walls", &M::walls, "m")
      .or_one()
      .at_least(0)
      .doc(
          "Thickness of its walls beyond the box around the parts: one for all, or six: lowest and highest "
          "x, y and z. 0: the parts end where the mould ends.");
  s.key("core", &M::core)
      .initially("core")
      .doc("Name of the mould in closed cavities of the parts; several are core_1, core_2, ...");
  s.key("bed", &M::bed)
      .initially(false)
      .doc(
          "With [[mesh.coat]]: the part of the block beyond the coats stays, as a bed of sand around the "
          "shell; without it that part is empty.");
  s.place(&M::where);
  return s;
}

/// Keys of a coat of an investment shell.
Section<MeshCoatSpec> coat_keys() {
  using C = MeshCoatSpec;
  Section<C> s(
      "coat",
      "A coat of a shell around everything that the geometry holds, as it is dipped for investment casting: "
      "the part of the block [mesh.mould] whose distance from the metal is at most the thickness of this "
      "coat and those before it. Coats are listed from the metal outward. Shells of neighbouring parts "
      "merge, narrow holes are filled, and where the block ends with the parts (a wall of 0) the "
      "shell is open.");
  s.key("name", &C::name).doc("Its name, as a group of the mesh: a body.");
  s.quantity("thickness", &C::thickness, "m")
      .positive()
      .doc("Its thickness, normal to the surface of the metal.");
  s.place(&C::where);
  return s;
}

/// Keys of a plane of symmetry at which a geometry is cut.
Section<SymmetrySpec> symmetry_keys() {
  using S = SymmetrySpec;
  Section<S> s("symmetry", "Only the half of the geometry below a plane is kept.");
  s.key("axis", &S::axis).choices({"x", "y", "z"}).doc("The axis normal to the plane.");
  s.quantity("at", &S::at, "m").doc("Where the plane crosses it.");
  s.place(&S::where);
  return s;
}

/// Keys of layers of thin elements at a surface.
Section<MeshLayersSpec> layers_keys() {
  using L = MeshLayersSpec;
  Section<L> s(
      "layers",
      "Thin layers of a body's elements on one of its surfaces, for a mould whose elements are thicker than "
      "the sand that warms in the first minutes: without layers the casting freezes too soon on a coarse "
      "mesh. "
      "The other elements of the body are moved inward to make room for them. Each costs about one node per "
      "node of the surface. "
      "Sections "
      "of one body with equal number and growth are made together: where their surfaces meet, so do the "
      "layers.");
  s.key("name", &L::name).doc("The name of the layers, for `include` and `--set`.");
  s.key("surface", &L::surface).doc("The surface, on the body's own side.");
  s.key("body", &L::body).doc("The group of the mesh in which the layers lie: the mould.");
  s.key("number", &L::number).initially(2).range(0, 20).doc("How many; 0: none.");
  s.key("growth", &L::growth)
      .initially(2.0)
      .range(1, 10)
      .doc("Thickness of a layer over that of the one before it, which is nearer to the surface.");
  s.quantity("first", &L::first, "m")
      .positive()
      .doc(
          "Thickness of the layer on the surface; without it all layers together are 0.8 times as thick as "
          "an edge of the surface is long. Layers are thinner where there is no room.");
  s.place(&L::where);
  return s;
}

}  // namespace

/// Keys of [mesh]: where it comes from, units and sizes of a file, the built-in shapes, and the sections that
/// make groups, sizes, mould, riser and layers.
Section<MeshSpec> mesh_keys() {
  Section<MeshSpec> s("mesh",
                      "The mesh: a file, or a built-in shape with its parameters in a section of its own.");
  s.key("shape", &MeshSpec::shape)
      .choices({"cylinder_in_mould", "block", "two_blocks"})
      .doc("A built-in shape; give this or `file`.");
  s.key("file", &MeshSpec::file)
      .doc(
          "A mesh (.msh, Abaqus .inp, .vtu, .unv, ...) or a geometry that Gmsh meshes (.geo, STEP, ...); "
          "relative to the case file. A "
          ".geo "
          "script may only make geometry (SECURITY.md), unless the program is started with --trust-geo.");
  s.key("unit", &MeshSpec::unit)
      .initially("")
      .doc(
          "Unit of length of the file, for example \"mm\"; without it \"m\". STEP and IGES files name "
          "theirs: "
          "there it is not needed, and another one is refused.");
  s.quantity("element_size", &MeshSpec::element_size, "m")
      .positive()
      .doc("Element size for files that hold a geometry (.geo, STEP); without it that of the file.");
  s.key("size_factor", &MeshSpec::size_factor)
      .initially(1.0)
      .positive()
      .doc(
          "Factor on all element sizes of a file that holds a geometry, those in a .geo script included; "
          "numbers of elements that a script sets (transfinite lines, layers) stay.");
  s.key("order", &MeshSpec::order)
      .initially(1)
      .range(1, 2)
      .doc("Order of the elements for files that hold a geometry.");
  s.key("element", &MeshSpec::element)
      .initially("tri3")
      .choices({"tri3", "tri6", "quad4", "quad8", "tet4", "tet10", "hex8", "hex20"})
      .doc("Element of the built-in shapes.");
  s.sections("constant", &MeshSpec::constants, constant_keys());
  s.sections("group", &MeshSpec::groups, group_keys());
  s.sections("layers", &MeshSpec::layers, layers_keys());
  s.key("refine", &MeshSpec::refine)
      .initially(0)
      .range(0, 6)
      .doc(
          "Number of times that all edges of the mesh are halved, whatever the mesh was made from: each time "
          "a "
          "solid has eight times as many elements, a plane mesh four times. Each process refines its own "
          "part, "
          "so that no process holds the whole refined mesh.");
  s.key("refined_skin", &MeshSpec::refined_skin)
      .initially("automatic")
      .choices({"automatic", "curved", "flat"})
      .doc(
          "Where `refine` puts new nodes on the surface of linear elements. \"curved\": on arcs through the "
          "smooth parts of the surface, in which neighbouring faces bend by less than 30 degrees; \"flat\": "
          "in "
          "the middle of the edges; \"automatic\": curved, but flat for linear tetrahedra that are made of a "
          "CAD geometry, whose flat faces already enclose the volume of the curved ones. Elements of second "
          "order keep their own shape.");
  s.key("conforming", &MeshSpec::conforming)
      .initially(false)
      .doc(
          "For STEP, BREP and IGES: bodies that touch share the faces between them, and so the nodes. "
          "Otherwise each body has faces and nodes of its own, for contact.");
  s.key("way", &MeshSpec::way)
      .initially(0)
      .range(0, 9)
      .doc(
          "With [[mesh.size]]: the number of the way of meshing (a set of settings of the mesh generator) "
          "that is used, whatever the quality of its elements; 0: they are tried in turn until one gives "
          "sound elements. `solidus new` writes this key where several had to be tried.");
  s.sections("size", &MeshSpec::sizes, size_keys());
  s.section("mould", &MeshSpec::mould, mould_keys());
  s.sections("coat", &MeshSpec::coats, coat_keys());
  s.sections("riser", &MeshSpec::risers, riser_keys()).or_one();
  s.sections("gating", &MeshSpec::gatings, gating_keys());
  s.sections("chill", &MeshSpec::chills, chill_keys());
  s.section("symmetry", &MeshSpec::symmetry, symmetry_keys());
  s.section("cylinder_in_mould", &MeshSpec::cylinder_in_mould, cylinder_in_mould_keys())
      .when("shape", {"cylinder_in_mould"});
  s.section("block", &MeshSpec::block, block_keys()).when("shape", {"block"});
  s.section("two_blocks", &MeshSpec::two_blocks, two_blocks_keys()).when("shape", {"two_blocks"});
  s.place(&MeshSpec::where);
  return s;
}

}  // namespace solidus::cases
