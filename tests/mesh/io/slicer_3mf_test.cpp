// What slicers put into 3MF packages beside material.
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/io/read_3mf.hpp"
#include "mesh/mesh_folder.hpp"
#include "mesh/threemf_package.hpp"

namespace kreisel::core {
namespace THIS_FILE {

using namespace threemf_package;

class Slicer3mf : public MeshFolder {
 protected:
  /// The triangles of a package, with what the notes must have in them, a part each.
  std::size_t triangles(const std::string& bytes, const std::vector<std::string>& told) const {
    const MeshReading reading = read_mesh_file(file("a.3mf", bytes));
    EXPECT_EQ(reading.notes.size(), told.size());
    for (const std::string& part : told)
      EXPECT_TRUE(std::ranges::any_of(reading.notes, [&](const std::string& note) {
        return note.find(part) != note.npos;
      })) << part;
    return reading.mesh.triangles.size();
  }
};

const std::string both = build(item + "<item objectid=\"2\"/>");

TEST_F(Slicer3mf, ColoursAndMaterialsDoNoHarm) {
  const std::string colours =
      "<m:colorgroup id=\"5\"><m:color color=\"#FF0000\"/></m:colorgroup>"
      "<basematerials id=\"6\"><base name=\"PLA\" displaycolor=\"#FFFFFF\"/></basematerials>";
  std::string coloured = object(1);
  coloured.insert(coloured.find("/>", coloured.find("<triangle ")), " pid=\"5\" p1=\"0\"");
  EXPECT_EQ(triangles(package(resources(colours + coloured) + build(item),
                              "unit=\"millimeter\" "
                              "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
                              "requiredextensions=\"m\""),
                      {}),
            4u);
}

TEST_F(Slicer3mf, LeavesOutObjectsThatAreNoModels) {
  for (const std::string type : {"support", "solidsupport", "surface", "other"})
    EXPECT_EQ(triangles(package(resources(object(1) + object(2, type)) + both), {type}), 4u);
}

TEST_F(Slicer3mf, LeavesOutWhatIsNotToBePrinted) {
  EXPECT_EQ(
      triangles(
          package(resources(object(1) + object(2)) +
                  build("<item objectid=\"1\" printable=\"1\"/><item objectid=\"2\" printable=\"0\"/>")),
          {"not to be printed"}),
      4u);
}

/// PrusaSlicer's settings of object 1, whose last two triangles are a volume with the given metadata.
std::string prusa(const std::string& metadata) {
  return package(resources(object(1)) + build(item), "unit=\"millimeter\"",
                 {{"Metadata/Slic3r_PE_model.config",
                   xml +
                       "<config><object id=\"1\"><metadata type=\"object\" key=\"name\" value=\"part\"/>"
                       "<volume firstid=\"0\" lastid=\"1\"><metadata type=\"volume\" key=\"volume_type\" "
                       "value=\"ModelPart\"/></volume><volume firstid=\"2\" lastid=\"3\">" +
                       metadata + "</volume></object></config>"}});
}

TEST_F(Slicer3mf, LeavesOutTheVolumesOfPrusaSlicerThatAreNoMaterial) {
  const std::string type = "<metadata type=\"volume\" key=\"volume_type\" value=\"";
  EXPECT_EQ(triangles(prusa(type + "ModelPart\"/>"), {}), 4u);
  EXPECT_EQ(triangles(prusa(type + "ParameterModifier\"/>"), {"modifier"}), 2u);
  EXPECT_EQ(triangles(prusa(type + "SupportBlocker\"/>"), {"support blocker"}), 2u);
  EXPECT_EQ(triangles(prusa(type + "SupportEnforcer\"/>"), {"support enforcer"}), 2u);
  EXPECT_EQ(triangles(prusa("<metadata type=\"volume\" key=\"modifier\" value=\"1\"/>"), {"modifier"}), 2u);
  refuses(file("n.3mf", prusa(type + "NegativeVolume\"/>")), {"negative volume", "subtracted"});
  refuses(file("u.3mf", prusa(type + "Cheese\"/>")), {"'Cheese'", "modifier"});
}

/// BambuStudio's: the components are in models of their own, and one of them has a kind.
std::string bambu(const std::string& kind) {
  const std::string to = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
  return package(resources("<object id=\"3\" type=\"model\"><components>"
                           "<component p:path=\"/3D/Objects/object_1.model\" objectid=\"1\"/>"
                           "<component p:path=\"/3D/Objects/object_1.model\" objectid=\"2\" "
                           "transform=\"1 0 0 0 1 0 0 0 1 50 0 0\"/></components></object>") +
                     build("<item objectid=\"3\" printable=\"1\"/>"),
                 "unit=\"millimeter\" xmlns:p=\"" + to + "\" requiredextensions=\"p\"",
                 {{"3D/Objects/object_1.model", model(resources(object(1) + object(2)) + build(""))},
                  {"Metadata/model_settings.config",
                   xml +
                       "<config><object id=\"3\"><metadata key=\"name\" value=\"a\"/><part id=\"1\" "
                       "subtype=\"normal_part\"/><part id=\"2\" subtype=\"" +
                       kind + "\"><metadata key=\"name\" value=\"b\"/></part></object><plate/></config>"}});
}

TEST_F(Slicer3mf, LeavesOutThePartsOfBambuStudioThatAreNoMaterial) {
  EXPECT_EQ(triangles(bambu("normal_part"), {}), 8u);
  EXPECT_EQ(triangles(bambu("modifier_part"), {"modifier"}), 4u);
  EXPECT_EQ(triangles(bambu("support_blocker"), {"support blocker"}), 4u);
  EXPECT_EQ(triangles(bambu("support_enforcer"), {"support enforcer"}), 4u);
  refuses(file("n.3mf", bambu("negative_part")), {"negative volume"});
}

TEST_F(Slicer3mf, LeavesOutTheMeshesOfCuraThatAreNoMaterial) {
  for (const std::string key : {"support_mesh", "infill_mesh", "cutting_mesh", "anti_overhang_mesh"}) {
    const std::string old_way =
        "<settings xmlns=\"http://software.ultimaker.com/xml/cura/3mf/2015/10\">"
        "<setting key=\"" +
        key + "\">True</setting></settings>";
    const auto group = [&](const std::string& value) {
      return "<metadatagroup><metadata name=\"cura:" + key + "\" type=\"xs:string\" preserve=\"1\">" + value +
             "</metadata></metadatagroup>";
    };
    for (const std::string& said : {old_way, group("True")})
      EXPECT_EQ(triangles(package(resources(object(1) + object(2, "model", "2 0 3", "0", said)) + both),
                          {key == "anti_overhang_mesh" ? "support blocker" : key.substr(0, key.find('_'))}),
                4u)
          << said;
    EXPECT_EQ(
        triangles(package(resources(object(1) + object(2, "model", "2 0 3", "0", group("False"))) + both),
                  {}),
        8u);
  }
}

TEST_F(Slicer3mf, RefusesARequiredExtensionByItsName) {
  const std::string beams =
      "unit=\"millimeter\" "
      "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\"";
  const std::string lattice =
      "<b:beamlattice minlength=\"1\" radius=\"1\"><b:beams><b:beam v1=\"0\" v2=\"1\"/>"
      "</b:beams></b:beamlattice>";
  std::string with_beams = object(1);
  with_beams.insert(with_beams.find("</mesh>"), lattice);
  refuses(file("a.3mf", package(resources(with_beams) + build(item), beams + " requiredextensions=\"b\"")),
          {"beamlattice/2017/02", "requires"});
  // Whoever does not require it says that the mesh alone will do; it is told all the same.
  EXPECT_EQ(triangles(package(resources(with_beams) + build(item), beams), {"beamlattice"}), 4u);
}

TEST_F(Slicer3mf, TakesTheUnitOfEveryModelForItself) {
  const std::string to = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
  const TriangleMesh mesh =
      read("a.3mf",
           package(resources("<object id=\"3\"><components><component p:path=\"/3D/b.model\" objectid=\"1\" "
                             "transform=\"1 0 0 0 1 0 0 0 1 7 0 0\"/></components></object>") +
                       build("<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 0 5 0\"/>"),
                   "unit=\"millimeter\" xmlns:p=\"" + to + "\"",
                   {{"3D/b.model", model(resources(object(1)) + build(""), "unit=\"inch\"")}}));
  EXPECT_EQ(mesh.vertices[1], Vec3(7 + 25.4, 5, 0));
}

TEST_F(Slicer3mf, RefusesComponentsThatGoRoundInACircle) {
  const auto holds = [](int id, int other) {
    return "<object id=\"" + std::to_string(id) + "\"><components><component objectid=\"" +
           std::to_string(other) + "\"/></components></object>";
  };
  refuses(file("a.3mf", package(resources(holds(1, 2) + holds(2, 1)) + build(item))), {"Object", "deep"});
}

TEST_F(Slicer3mf, SaysWhatWasLeftOutWhereNothingIsLeft) {
  refuses(file("a.3mf", package(resources(object(1, "support")) + build(item))), {"no triangles", "support"});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core
