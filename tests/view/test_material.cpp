// The material of Somigliana coordinates in the window.
#include <boost/test/unit_test.hpp>

#include <array>

#include <tools/view/files/file_contents.h>
#include <tools/view/state/cage_changes.h>
#include <tools/view/state/words.h>
#include <view/support/app_fixture.h>

using namespace vdbcage;
using namespace vdbcage::test;
using namespace vdbcage::view;
using openvdb::Vec3d;

namespace {

struct Fixture : AppFixture {
    App app{context.api(), setup()};

    Fixture()
    {
        app.resize(1280, 1300); // no panel is scrolled
        run(app,
            {"open " + quotedWord(files[0]), "wait", "mode pose", "select points 0 1 2 3", "move 0 0.5 0", "wait"});
    }
    std::vector<Vec3d> points() const { return cagePoints(app.session().state(), app.session().cage()); }
    std::string file(const std::string& name) const { return quotedWord((folder / name).string()); }
};

} // namespace

BOOST_FIXTURE_TEST_SUITE(material, Fixture)

BOOST_AUTO_TEST_CASE(what_is_saved_has_the_material)
{
    const Elasticity elasticity{0.4, Elasticity::Rotations::local, 3, 5};
    run(app, {"coordinates somigliana", "wait", "save-posed-model " + file("plain.ply"),
              toText(SetMaterial{elasticity}), "save-posed-model " + file("seen.ply"),
              "save-posed-models " + file("m.%04d.ply"), "wait", "expect bound yes"});
    const State& state = app.session().state();
    const Mesh& model = state.document.model->mesh;
    const PosableCagePtr& cage = app.session().cage();
    const Binding binding = Binding(*cage->rest(), model.points, Coordinates::somigliana).with(elasticity);
    Mesh expected = model;
    expected.points = binding.pose(points());
    writeMesh(expected, folder / "expected.ply");
    BOOST_TEST(readMesh(folder / "seen.ply").points == readMesh(folder / "expected.ply").points,
               boost::test_tools::per_element());
    BOOST_TEST((readText(folder / "m.0000.ply") == readText(folder / "seen.ply")));
    BOOST_TEST((readText(folder / "plain.ply") != readText(folder / "seen.ply")));
    // Where nothing is bound yet.
    savePosedModels({bindOrder(state.document, cage->rest()), nullptr, elasticity, state.document.poses, *cage, 0, 0},
                    folder / "bound.ply", nullptr);
    BOOST_TEST((readText(folder / "bound.ply") == readText(folder / "seen.ply")));
}

BOOST_AUTO_TEST_CASE(the_material_is_there_where_it_acts)
{
    const std::vector<std::string> names{"material.nu", "material.local-bulging", "material.global-bulging",
                                         "material.global", "material.local"};
    const auto areThere = [&](bool there) {
        for (const std::string& name : names) BOOST_TEST(app.widget(name).has_value() == there, name);
    };
    areThere(false);
    runLine(app, "compare somigliana");
    areThere(true);
    runLine(app, "compare off");
    areThere(false);
    run(app, {"coordinates somigliana", "wait"});
    areThere(true);
    runLine(app, "mode shape");
    areThere(false);
    // Weights of a file can be of the family.
    run(app, {"mode pose", "save-weights " + file("w.npy"), "open-weights " + file("w.npy"), "wait",
              "expect coordinates given"});
    areThere(true);
}

BOOST_AUTO_TEST_CASE(a_drag_of_a_slider_of_the_material_is_one_step)
{
    run(app, {"coordinates somigliana", "wait", "expect material \"0 global 0 0\""});
    const std::string before = app.value("undo");
    const auto picture = [&] {
        run(app, {"wait", "mouse move picture 0.02 0.98"});
        return app.picture();
    };
    const draw::Picture plain = picture();
    for (const auto& [name, least, most] :
         std::vector<std::array<std::string, 3>>{{"material.nu", "-0.9 global 0 0", "0.45 global 0 0"},
                                                 {"material.local-bulging", "0 global 0 0", "0 global 30 0"},
                                                 {"material.global-bulging", "0 global 0 0", "0 global 0 30"}}) {
        run(app, {"mouse move " + name + " 0.5", "mouse down", "mouse move " + name + " 0.7",
                  "mouse move " + name + " -0.2", "expect material \"" + least + "\"", "mouse move " + name + " 1.2",
                  "expect bound yes", "mouse up", "expect material \"" + most + "\""});
        BOOST_TEST(recorded.back() == "material " + most);
        BOOST_TEST(!samePicture(picture(), plain));
        run(app, {"undo", "expect material \"0 global 0 0\""});
        BOOST_TEST(app.value("undo") == before);
        BOOST_TEST(samePicture(picture(), plain));
        BOOST_TEST(!app.widget(name + ".reset"));
        run(app, {"redo", "widget " + name + ".reset press", "expect material \"0 global 0 0\"", "undo", "undo"});
    }
    run(app, {"widget material.local press", "expect material \"0 local 0 0\"", "widget material.global press",
              "expect material \"0 global 0 0\"", "expect bound yes", "expect messages 0"});
}

BOOST_AUTO_TEST_CASE(the_second_picture_has_the_material)
{
    run(app, {"compare somigliana", "wait", "mouse move picture 0.02 0.98"});
    // The right half, without the panels.
    const auto right = [&] {
        const draw::Picture all = app.picture();
        const Rectangle place = app.picturePlace();
        std::vector<std::uint8_t> bytes;
        for (int y = place.top; y < place.top + place.height; ++y) {
            const auto row = all.rgb.begin() + std::ptrdiff_t{3} * y * all.width;
            bytes.insert(bytes.end(), row + std::ptrdiff_t{3} * (place.left + place.width / 2),
                         row + std::ptrdiff_t{3} * (place.left + place.width));
        }
        return bytes;
    };
    const std::vector<std::uint8_t> plain = right();
    run(app, {"material 0.4 local 3 5", "wait"});
    BOOST_TEST((right() != plain));
    run(app, {"undo", "wait"});
    BOOST_TEST((right() == plain));
}

BOOST_AUTO_TEST_SUITE_END()
