// CSV and PLY as other programs write them: small files of the kinds that readers are reported to fail on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "core/formats/column_names.h"
#include "core/formats/particle_files.h"
#include "core/scene/validate.h"
#include "server/document/scene_text.h"

namespace awan {
namespace {

const std::vector<glm::dvec3> kPlaces = {{0, 0, 0}, {1, 0.2, 0.1}, {-0.8, 0.1, 0.3}};
const std::vector<float> kSizes = {0.8f, 0.7f, 0.9f};

std::string bytes_of(const std::string& name) {
    std::ifstream file(AWAN_TEST_DATA "/field/" + name, std::ios::binary);
    EXPECT_TRUE(file) << name;
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

struct Reading {
    Result<SceneDraft> draft;
    std::vector<std::string> notes;

    const ReadyParticles& ready() const { return draft->clouds.at(0).ready; }
    bool notes_say(const std::string& words) const {
        for (const std::string& note : notes)
            if (note.find(words) != std::string::npos) return true;
        return false;
    }
};

Reading read_as(SceneFormat format, const std::string& bytes, std::optional<double> radius = {}) {
    std::vector<std::string> notes;
    Result<SceneDraft> draft = read_scene(format, bytes, {radius, &notes});
    return {std::move(draft), std::move(notes)};
}

Reading csv(const std::string& text, std::optional<double> radius = {}) {
    return read_as(SceneFormat::kCsv, text, radius);
}

Reading file(const std::string& name, std::optional<double> radius = {}) {
    return read_as(*scene_format_of_name(name), bytes_of(name), radius);
}

void expect_error(const Reading& reading, const std::string& pointer,
                  std::initializer_list<const char*> words) {
    ASSERT_FALSE(reading.draft.ok());
    EXPECT_EQ(reading.draft.error().pointer, pointer) << reading.draft.error().message;
    for (const char* const word : words)
        EXPECT_NE(reading.draft.error().message.find(word), std::string::npos)
            << reading.draft.error().message << " lacks " << word;
}

// --- every file of the field

TEST(FieldFiles, AllOfTheSameParticlesAreRead) {
    for (const char* const name :
         {"hash.csv", "semi.csv", "slash_header.csv", "tab.csv", "upper.csv", "utf16.csv", "be.ply",
          "bom.ply", "cr_ascii.ply", "elem_before.ply", "list_in_vertex.ply", "pscale.ply",
          "width.ply"}) {
        const Reading reading = file(name);
        ASSERT_TRUE(reading.draft.ok()) << name << ": " << reading.draft.error().message;
        ASSERT_EQ(reading.ready().positions.size(), 3u) << name;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(glm::distance(reading.ready().positions[i], kPlaces[i]), 0, 1e-7) << name;
            EXPECT_FLOAT_EQ(reading.ready().radii[i], kSizes[i]) << name;
        }
        EXPECT_TRUE(validate(*reading.draft).ok()) << name;
    }
}

TEST(FieldFiles, ShorterOnesToo) {
    for (const char* const name :
         {"semi_deccomma.csv", "trailing_rows.csv", "pdal.csv", "paraview.csv"}) {
        const Reading reading = file(name);
        ASSERT_TRUE(reading.draft.ok()) << name << ": " << reading.draft.error().message;
        EXPECT_EQ(reading.ready().positions, (std::vector<glm::dvec3>{kPlaces[0], kPlaces[1]}))
            << name;
        EXPECT_EQ(reading.ready().radii, (std::vector<float>{0.8f, 0.7f})) << name;
    }
    EXPECT_TRUE(file("semi_deccomma.csv").notes_say("decimal commas"));
}

TEST(FieldFiles, AnEmptyDensityIsTheMeanOfTheOthersAndSaid) {
    const Reading reading = file("empty_cell.csv");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().densities, (std::vector<float>{3, 3}));
    EXPECT_TRUE(reading.notes_say("density is empty for 1 of 2"));
}

TEST(FieldFiles, ColoursOfBytesInATableAreScaledAndSaid) {
    const Reading reading = file("rgb255.csv");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().colors, (std::vector<glm::vec3>{{1, 1, 1}, {1, 128.0f / 255.0f, 0}}));
    EXPECT_TRUE(reading.notes_say("255 is white"));
}

TEST(FieldFiles, ASetWithoutRadiiNeedsOne) {
    expect_error(file("no_radius.ply"), "line 3", {"radius", "--radius"});
    const Reading reading = file("no_radius.ply", 0.5);
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().radii, (std::vector<float>{0.5f, 0.5f, 0.5f}));
}

// Splats of known scales and opacities, so that the depth through the middle is known.
TEST(FieldFiles, SplatsAreGaussiansOfTheirScaleAndOpacity) {
    const Reading reading = file("gs.ply");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_TRUE(reading.notes_say("splats"));
    EXPECT_TRUE(validate(*reading.draft).ok());
    const Reading one = read_as(
        SceneFormat::kPly,
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nproperty float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\n"
        "property float opacity\nproperty float scale_0\nproperty float scale_1\n"
        "property float scale_2\nproperty float rot_0\nend_header\n"
        "1 2 3 1.7724538 0 -9 1.0986123 -1 -2 -3 1\n");
    ASSERT_TRUE(one.draft.ok()) << one.draft.error().message;
    const double s = std::exp(-2.0);
    EXPECT_NEAR(static_cast<double>(one.ready().radii[0]), 2 * s, 1e-6);
    // The logit 1.0986 is an opacity of 3/4, which is an optical depth of ln 4.
    EXPECT_NEAR(static_cast<double>(one.ready().densities[0]) * s * std::sqrt(2 * std::numbers::pi),
                std::log(4.0), 1e-5);
    // 1/2 + 1.7724538 / (2 sqrt(pi)) = 1.
    EXPECT_NEAR(static_cast<double>(one.ready().colors[0].r), 1.0, 1e-6);
    EXPECT_NEAR(static_cast<double>(one.ready().colors[0].g), 0.5, 1e-6);
    EXPECT_EQ(one.ready().colors[0].b, 0);
}

// --- CSV

TEST(TableCsv, QuotesMayHoldSeparatorsLineEndsAndQuotes) {
    const Reading reading =
        csv("\"na\"\"me\",x,y,z,\"radius\"\n\"a, \"\"b\"\"\nand c\",\"1\",2,3,\" 4 "
            "\"\nplain,5,6,7,8\n");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().positions, (std::vector<glm::dvec3>{{1, 2, 3}, {5, 6, 7}}));
    EXPECT_EQ(reading.ready().radii, (std::vector<float>{4, 8}));
    expect_error(csv("x,y,z,radius\n1,2,3,4\n1,2,\"3,4\n"), "line 3", {"quote", "not closed"});
    expect_error(csv("x,y,z,radius\n1,2,\"3\"x,4\n"), "line 2", {"closing quote", "3"});
    // After a cell of two lines the count of lines goes on.
    expect_error(csv("n,x,y,z,radius\n\"a\nb\",1,2,3,4\nc,1,2,3,four\n"), "line 4, column 5",
                 {"radius", "four"});
}

TEST(TableCsv, AHeaderMayHaveALineEndInItsQuotes) {
    const Reading reading = csv("x,y,z,radius,\"of\nwhat\"\n1,2,3,4,\n");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().radii, (std::vector<float>{4}));
}

TEST(TableCsv, WhateverSeparates) {
    for (const char* const text :
         {"x,y,z,radius\n1,2,3,4\n", "x;y;z;radius\n1;2;3;4\n", "x\ty\tz\tradius\n1\t2\t3\t4\n",
          "x|y|z|radius\n1|2|3|4\n", "x y z radius\n1  2 3\t4\n",
          "  x  y  z  radius\n  1.0  2.0  3.0  4.0\n", "//X Y Z R\n1 2 3 4\n",
          "# comment\n#x;y;z;radius\n1;2;3;4\n", "sep=;\nx;y;z;radius\n1;2;3;4\n",
          "% x, y, z, radius\n1, 2, 3, 4\n", "x,y,z,radius\r1,2,3,4\r",
          "\n\nx,y,z,radius\n\n1,2,3,4\n,,,\n", "x,y,z,radius,\n1,2,3,4,\n",
          "x,y,z,radius\n1,2,3,4,,,\n", "x,y,z,radius\n+1,2.,+3.0,4e0"}) {
        const Reading reading = csv(text);
        ASSERT_TRUE(reading.draft.ok()) << text << ": " << reading.draft.error().message;
        EXPECT_EQ(reading.ready().positions, (std::vector<glm::dvec3>{{1, 2, 3}})) << text;
        EXPECT_EQ(reading.ready().radii, (std::vector<float>{4})) << text;
    }
}

TEST(TableCsv, DecimalCommasAndPointsDoNotMix) {
    const Reading reading = csv("x\ty\tz\tradius\n1,5\t2\t3\t-,5\n");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().radii, (std::vector<float>{-0.5f}));
    expect_error(csv("x;y;z;radius\n1,5;2;3;4\n1;2.5;3;4\n"), "line 3, column 2",
                 {"decimal comma", "decimal point"});
    expect_error(csv("x;y;z;radius\n1;2;3;1.234,5\n"), "line 2, column 4", {"radius", "1.234,5"});
    expect_error(csv("x,y,z,radius\n1,2,3,\"0,8\"\n"), "line 2, column 4",
                 {"radius", "decimal comma", "tab"});
}

TEST(TableCsv, NamesOfOtherToolsAreKnown) {
    const struct {
        const char *header, *row;
    } tables[] = {
        {"P[x],P[y],P[z],pscale", "1,2,3,4"},
        {"P.x,P.y,P.z,pscale", "1,2,3,4"},
        {"Points_0,Points_1,Points_2,Radius", "1,2,3,4"},
        {"position_x,position_y,position_z,diameter", "1,2,3,8"},
        {"CENTER X;CENTER Y;CENTER Z;WIDTH", "1;2;3;8"},
        {"posx,posy,posz,rad", "1,2,3,4"},
        {"x,y,z,radius_x,radius_y,radius_z", "1,2,3,2,4,8"},
        {"x,y,z,radius_x", "1,2,3,4"},
        {"x,y,z,r", "1,2,3,4"},
        {"y,x,radius,z,width", "2,1,4,3,99"},
    };
    for (const auto& table : tables) {
        const Reading reading = csv(std::string(table.header) + "\n" + table.row + "\n");
        ASSERT_TRUE(reading.draft.ok()) << table.header << ": " << reading.draft.error().message;
        EXPECT_EQ(reading.ready().positions, (std::vector<glm::dvec3>{{1, 2, 3}})) << table.header;
        EXPECT_FLOAT_EQ(reading.ready().radii[0], 4) << table.header;
    }
    for (const char* const names :
         {"Red,Green,Blue", "R,G,B", "Cd[r],Cd[g],Cd[b]", "Cd.x,Cd.y,Cd.z",
          "diffuse_red,diffuse_green,diffuse_blue", "color_0,color_1,color_2"}) {
        const Reading reading =
            csv("x,y,z,radius," + std::string(names) + "\n1,2,3,4,.25,.5,.75\n");
        ASSERT_TRUE(reading.draft.ok()) << names;
        EXPECT_EQ(reading.ready().colors, (std::vector<glm::vec3>{{0.25f, 0.5f, 0.75f}})) << names;
    }
    for (const char* const name :
         {"id", "vx", "temperature", "time", "", "intensity", "normal_x", "scale_x"})
        EXPECT_FALSE(known_name(name)) << name;
}

TEST(TableCsv, WhatOtherToolsWriteAroundTheirNumbers) {
    const struct {
        const char *text, *note;
    } tables[] = {
        // R: names of rows without a name of their own. A data frame printed by Python.
        {"\"x\" \"y\" \"z\" \"radius\"\n\"1\" 1 2 3 4\n", "first cell"},
        {"     x    y    z  radius\n0  1.0  2.0  3.0     4.0\n", "first cell"},
        {"\"\";\"x\";\"y\";\"z\";\"radius\"\n\"1\";1;2;3;4\n", ""},
        // Units behind the names, and below them.
        {"x [m],y [m],z [m],radius [m]\n1,2,3,4\n", ""},
        {"X (m);Y (m);Z (m);Radius (m)\n1;2;3;4\n", ""},
        {"x_m,y_m,z_m,radius_m\n1,2,3,4\n", ""},
        {"x [m],y [m],z [m],r [m]\n1,2,3,4\n", "\"r [m]\""},
        {"x,y,z,radius\nm,m,m,m\n1,2,3,4\n", "line 2"},
        {"| x | y | z | radius |\n|---|---|---|---|\n| 1 | 2 | 3 | 4 |\n", "line 2"},
        // Titles above them.
        {"Particles of frame 12\n\nx,y,z,radius\n1,2,3,4\n", "above line 3"},
        {"Frame,12,,\nCount,1,,\nx,y,z,radius\n1,2,3,4\n", "above line 3"},
        // CloudCompare, with the number of points; its own fields.
        {"//X Y Z scalar_Radius\n1\n1 2 3 4\n", ""},
        // Unreal's and Houdini's vectors.
        {"---,Location,Radius\nA,\"(X=1.0,Y=2.0,Z=3.0)\",4\n", "\"---\""},
        {"ptnum,P,pscale\n0,\"(1, 2, 3)\",4\n", "\"ptnum\""},
        {"position\tradius\n[1 2 3]\t4\n", ""},
        // Blender's coordinates, yt's, Maya's.
        {"co.x,co.y,co.z,radius\n1,2,3,4\n", ""},
        {"particle_position_x,particle_position_y,particle_position_z,radius\n1,2,3,4\n", ""},
        {"positionX,positionY,positionZ,radiusPP\n1,2,3,4\n", ""},
        // Fortran's exponents; a minus as people write it.
        {"x y z radius\n 0.1D+01 0.2D+01 3.0d0 4.0E+00\n", ""},
    };
    for (const auto& table : tables) {
        const Reading reading =
            read_as(sniff_scene_format(table.text), table.text, std::optional<double>());
        ASSERT_TRUE(reading.draft.ok()) << table.text << ": " << reading.draft.error().message;
        EXPECT_EQ(reading.ready().positions, (std::vector<glm::dvec3>{{1, 2, 3}})) << table.text;
        EXPECT_EQ(reading.ready().radii, (std::vector<float>{4})) << table.text;
        EXPECT_TRUE(*table.note == 0 || reading.notes_say(table.note)) << table.text;
    }
    EXPECT_EQ(csv("x;y;z;radius\n\u22121,5;2;3;4\n").ready().positions[0].x, -1.5);
}

TEST(TableCsv, WhatIsTakenForOneThingIsNotAnother) {
    // Half of a decimal comma is no name of a row.
    expect_error(csv("x,y,z,radius\n1,2,3,0,8\n"), "line 2", {"4", "5"});
    // One row of words is no row of units.
    expect_error(csv("x,y,z,radius\na,b,c,d\n"), "line 2", {"finite"});
    expect_error(csv("x,y,z,radius\nm,m,m,m\n1,2,3,4\nm,m,m,m\n"), "line 4, column 1", {"\"m\""});
    expect_error(csv("x,y,z,radius\nnan,nan,nan,4\n1,2,3,4\n"), "line 2, column 1", {"nan"});
    expect_error(csv("//X Y Z radius\n2\n1 2 3 4\n"), "line 2", {"2 particles", "1 up to line 3"});
    expect_error(csv("x [m],y [m],z [m],radius [mm]\n1,2,3,4\n"), "line 1",
                 {"different units", "\"x [m]\"", "\"radius [mm]\""});
    expect_error(csv("a,Location,Radius\n0,\"(X=1,Y=2,Z=3)\",4\n0,\"(X=1,Y=2)\",4\n"),
                 "line 3, column 2", {"(X=1,Y=2)"});
}

TEST(TableCsv, ColoursOfVectorsAreFoundByTheirLetters) {
    const Reading reading =
        csv("Location,Color,Radius\n\"(X=1,Y=2,Z=3)\",\"(B=255,G=51,R=0,A=255)\",4\n");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().colors, (std::vector<glm::vec3>{{0, 0.2f, 1}}));
}

TEST(TableCsv, WordsForNoValueAreEmptyWhereACellMayBe) {
    const Reading reading =
        csv("x,y,z,radius,density\n0,0,0,1,1\n0,0,0,1,NA\n0,0,0,1,nan\n0,0,0,1,3\n");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().densities, (std::vector<float>{1, 2, 2, 3}));
    EXPECT_TRUE(reading.notes_say("empty for 2 of 4"));
    expect_error(csv("x,y,z,radius,density\n0,0,0,NA,1\n"), "line 2, column 4", {"radius", "NA"});
}

TEST(TableCsv, NumbersWithoutNamesArePlacesWhereTheRadiusIsGiven) {
    for (const char* const text : {"1 2 3\n4 5 6\n", "1,2,3\n4,5,6\n", "1e0\t2.0\t3\n4\t5\t6\n"}) {
        EXPECT_EQ(sniff_scene_format(text), SceneFormat::kCsv) << text;
        const Reading reading = csv(text, 0.5);
        ASSERT_TRUE(reading.draft.ok()) << text << reading.draft.error().message;
        EXPECT_EQ(reading.ready().positions, (std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}}));
        EXPECT_TRUE(reading.notes_say("x, y, z"));
        expect_error(csv(text), "line 1", {"no x", "put a line of names above the numbers"});
    }
    expect_error(csv("1 2 3 4\n", 0.5), "line 1", {"no x", "above the numbers"});
    EXPECT_EQ(sniff_scene_format("50\n1\n50, 1, 1, 1, 0, 0, 0, 1\n"), SceneFormat::kAwn);
}

TEST(TableCsv, NamesInMessagesAreWhole) {
    expect_error(csv("länge_der_wolke,y,z,radius\n"), "line 1", {"\"länge_der_wolke\""});
    expect_error(csv("x,y,z,size,scale\n1,2,3,4,5\n"), "line 1",
                 {"\"size\"", "\"scale\"", "--radius"});
    expect_error(csv(""), "line 1", {"there is nothing"});
    expect_error(csv(std::string("PK\x03\x04\0\0", 6)), "", {"ZIP", "CSV"});
}

TEST(TableCsv, WhatIsNotUsedIsSaid) {
    EXPECT_TRUE(csv("x,y,z,radius,Temperature,vx\n1,2,3,4,5,6\n")
                    .notes_say("not used: \"Temperature\", \"vx\""));
    EXPECT_TRUE(csv("x,y,z,radius,width\n1,2,3,4,5\n").notes_say("not used: \"width\""));
    EXPECT_TRUE(
        csv("x,y,z,radius,density,opacity\n1,2,3,4,5,.5\n").notes_say("not used: \"opacity\""));
    EXPECT_TRUE(csv("x,y,z,radius\n1,2,3,4\n", 2.0).notes_say("not used: \"radius\""));
    EXPECT_TRUE(csv("x,y,z,radius,density\n1,2,3,4,5\n").notes.empty());
}

TEST(TableCsv, OpacityIsADepthThroughTheMiddle) {
    const Reading reading = csv("x,y,z,radius,opacity\n0,0,0,2,0\n0,0,0,2,.5\n0,0,0,2,1\n");
    ASSERT_TRUE(reading.draft.ok());
    const double per_depth = std::sqrt(2 * std::numbers::pi);
    EXPECT_EQ(reading.ready().densities[0], 0);
    EXPECT_NEAR(static_cast<double>(reading.ready().densities[1]) * per_depth, std::log(2.0), 1e-6);
    EXPECT_NEAR(static_cast<double>(reading.ready().densities[2]) * per_depth, std::log(510.0),
                1e-5);
    expect_error(csv("x,y,z,radius,opacity\n0,0,0,2,1.5\n"), "line 2", {"opacity", "0 to 1"});
}

TEST(TableCsv, ColoursAreWholeOrNotThere) {
    const Reading reading = csv("x,y,z,radius,r,g,b\n0,0,0,1,,,\n0,0,0,1,51,0,255\n");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().colors, (std::vector<glm::vec3>{{1, 1, 1}, {0.2f, 0, 1}}));
    expect_error(csv("x,y,z,radius,r,g,b\n0,0,0,1,1,,1\n"), "line 2", {"colour"});
    const Reading wide = csv("x,y,z,radius,Red,Green,Blue\n0,0,0,1,65535,0,13107\n");
    EXPECT_EQ(wide.ready().colors, (std::vector<glm::vec3>{{1, 0, 0.2f}}));
}

TEST(TableCsv, LettersOfEveryScriptAreQuotedAsTheyAre) {
    expect_error(csv("x,y,z,radius\n1,2,3,größe\n"), "line 2, column 4", {"\"größe\""});
    expect_error(csv("x,y,z,radius\n1,2,3,雲\x1b[1m\n"), "line 2, column 4", {"\"雲\\x1B[1m\""});
    expect_error(csv("x,y,z,radius\n1,2,3,\xff\n"), "line 2, column 4", {"\"\\xFF\""});
}

TEST(TableCsv, NothingIsTakenForACommentThatMayBeData) {
    const Reading reading = csv("id,x,y,z,radius\n#1,1,2,3,4\n# made by hand\n#2,1,2,3,5\n");
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().radii, (std::vector<float>{4, 5}));
}

// --- PLY

template <typename T>
void put(std::string& out, T value, bool big_endian) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (big_endian) std::reverse(bytes, bytes + sizeof value);
    out.append(bytes, sizeof value);
}

TEST(FormsOfPly, ListsAndElementsAnywhereInBinaryOfEitherOrder) {
    for (const bool big : {false, true})
        for (const char* const end : {"\n", "\r\n", "\r"}) {
            std::string bytes =
                "ply\nformat binary_" + std::string(big ? "big" : "little") +
                "_endian 1.0\nobj_info made by a scanner\nelement camera 2\n"
                "property list uchar short grid\nproperty double t\nelement empty 1000000000000\n"
                "element vertex 2\nproperty list ushort float near\nproperty float x\n"
                "property double y\nproperty short z\nproperty uchar diffuse_red\n"
                "property uchar diffuse_green\nproperty uchar diffuse_blue\n"
                "property list int uchar far\nproperty float radius\nelement face 1\n"
                "property list uchar int vertex_indices\nend_header\n";
            std::string head;
            for (const char c : bytes) head += c == '\n' ? end : std::string(1, c);
            bytes = head;
            for (int i = 0; i < 2; ++i) {
                put<std::uint8_t>(bytes, static_cast<std::uint8_t>(i), big);
                for (int k = 0; k < i; ++k) put<std::int16_t>(bytes, 7, big);
                put(bytes, 0.5, big);
            }
            for (int i = 0; i < 2; ++i) {
                put<std::uint16_t>(bytes, static_cast<std::uint16_t>(2 * i), big);
                for (int k = 0; k < 2 * i; ++k) put(bytes, 1.5f, big);
                put(bytes, 1.5f + static_cast<float>(i), big);
                put(bytes, -2.25, big);
                put<std::int16_t>(bytes, 300, big);
                for (const int c : {255, 0, 51})
                    put<std::uint8_t>(bytes, static_cast<std::uint8_t>(c), big);
                put<std::int32_t>(bytes, 3, big);
                bytes += "abc";
                put(bytes, 0.125f, big);
            }
            put<std::uint8_t>(bytes, 1, big);
            put<std::int32_t>(bytes, 0, big);
            bytes += '\n';
            const Reading reading = read_as(SceneFormat::kPly, bytes);
            ASSERT_TRUE(reading.draft.ok())
                << reading.draft.error().pointer << reading.draft.error().message;
            EXPECT_EQ(reading.ready().positions,
                      (std::vector<glm::dvec3>{{1.5, -2.25, 300}, {2.5, -2.25, 300}}));
            EXPECT_EQ(reading.ready().radii, (std::vector<float>{0.125f, 0.125f}));
            EXPECT_EQ(reading.ready().colors, (std::vector<glm::vec3>{{1, 0, 0.2f}, {1, 0, 0.2f}}));
        }
}

TEST(FormsOfPly, CloudComparesFieldsAndOpacitiesOfBytesAreKnown) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nobj_info Generated by CloudCompare!\n"
        "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "property float scalar_Radius\nproperty uchar opacity\nend_header\n";
    for (const float value : {1.0f, 2.0f, 3.0f, 4.0f}) put(bytes, value, false);
    bytes += '\x33';
    const Reading reading = read_as(SceneFormat::kPly, bytes);
    ASSERT_TRUE(reading.draft.ok()) << reading.draft.error().message;
    EXPECT_EQ(reading.ready().radii, (std::vector<float>{4}));
    EXPECT_NEAR(
        static_cast<double>(reading.ready().densities[0]) * 2 * std::sqrt(2 * std::numbers::pi),
        -std::log(0.8), 1e-6);
}

TEST(FormsOfPly, ListsThatClaimMuchCostNothing) {
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement e 4000000000\nproperty list uint double "
        "l\nelement vertex 1\n"
        "property float x\nproperty float y\nproperty float z\nproperty float radius\nend_header\n";
    expect_error(read_as(SceneFormat::kPly, head + "\xff\xff\xff\xff" + std::string(64, '\0')), "",
                 {"\"e\"", "for 0"});
    expect_error(read_as(SceneFormat::kPly, head + std::string(64, '\0')), "", {"\"e\"", "for 16"});
    std::string signed_list = head;
    signed_list.replace(signed_list.find("uint"), 4, "int ");
    expect_error(
        read_as(SceneFormat::kPly, signed_list + "\xff\xff\xff\xff" + std::string(64, '\0')), "",
        {"for 0"});
}

TEST(FormsOfPly, WhatIsNoParticleIsSaid) {
    expect_error(read_as(SceneFormat::kPly, "ply\nformat ascii 1.0\nelement face 0\nend_header\n"),
                 "", {"vertex", "\"face\""});
    expect_error(read_as(SceneFormat::kPly,
                         "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar float x\n"
                         "property float y\nproperty float z\nproperty float radius\nend_header\n"),
                 "line 3", {"\"x\"", "list"});
    expect_error(read_as(SceneFormat::kPly,
                         "ply\nformat ascii 1.0\nelement vertex 1\nproperty uint packed_position\n"
                         "end_header\n0\n"),
                 "", {"packed"});
    expect_error(read_as(SceneFormat::kPly,
                         "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float float x\n"),
                 "line 4", {"length", "integer", "\"float\""});
}

}  // namespace
}  // namespace awan
