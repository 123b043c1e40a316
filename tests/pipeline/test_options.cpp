#include <boost/test/unit_test.hpp>

#include <limits>

#include <filesystem>
#include <fstream>
#include <support/option_values.h>
#include <support/temporary_folder.h>
#include <vdbcage/core/error.h>
#include <vdbcage/pipeline/options.h>

using namespace vdbcage;

namespace {

bool names(const Error& error, const std::string& text)
{
    return std::string(error.what()).find(text) != std::string::npos;
}

} // namespace

BOOST_AUTO_TEST_SUITE(options)

BOOST_AUTO_TEST_CASE(every_option_is_described_and_valid_by_default)
{
    const auto described = describeOptions();
    const auto values = optionValues(CageOptions{});
    BOOST_REQUIRE(described.size() == values.size());
    for (std::size_t i = 0; i < described.size(); ++i) {
        BOOST_TEST(described[i].name == values[i].first);
        BOOST_TEST(described[i].defaultValue == values[i].second);
        BOOST_TEST(!described[i].help.empty());
    }
    BOOST_CHECK_NO_THROW(requireValid(CageOptions{}));
}

BOOST_AUTO_TEST_CASE(text_goes_in_and_comes_out)
{
    CageOptions options;
    const std::vector<OptionText> described = describeOptions();
    auto expected = optionValues(options);
    for (std::size_t i = 0; i < described.size(); ++i) {
        const std::vector<std::string> values = test::otherValues(described[i]);
        BOOST_TEST(values.empty() == (described[i].value == "FILE")); // joints have a test of their own
        for (const std::string& value : values) {
            setOption(options, described[i].name, value);
            expected[i].second = value;
            BOOST_CHECK_MESSAGE(optionValues(options) == expected, described[i].name << ' ' << value);
        }
    }
    for (const OptionText& option : described) setOption(options, option.name, option.defaultValue);
    BOOST_CHECK(optionValues(options) == optionValues(CageOptions{}));

    const std::vector<std::pair<std::string, std::string>> given{
        {"faces", "100"},   {"resolution", "64"}, {"erode-radius", "0.0625"}, {"element", "cube"},
        {"parts", "merge"}, {"mesh", "triquad"},  {"bounding", "off"},        {"effort", "best"}};
    for (const auto& [name, value] : given) setOption(options, name, value);
    BOOST_TEST(options.faces == 100);
    BOOST_TEST(options.erodeRadius.value() == 0.0625);
    BOOST_CHECK(options.element == StructuringElement::cube);
    BOOST_CHECK(options.mesh == CageFaces::triquad);
    BOOST_TEST(!options.bounding);
    setOption(options, "erode-radius", "auto");
    BOOST_TEST(!options.erodeRadius.has_value());
    BOOST_TEST(options.resolution.value() == 64);
    setOption(options, "resolution", "auto");
    BOOST_TEST(!options.resolution.has_value());
    BOOST_CHECK(options.parts == CageParts::merge);
    BOOST_CHECK(options.effort == Effort::best);
}

BOOST_AUTO_TEST_CASE(a_scale_field_is_given_as_text)
{
    CageOptions options;
    const std::string text = "sphere:0,1,-2.5,0.5,0.25;box:0,3,0,1,1,1,0";
    setOption(options, "scale-field", text);
    const auto values = optionValues(options);
    BOOST_TEST(std::count(values.begin(), values.end(), std::pair(std::string("scale-field"), text)) == 1);
    BOOST_REQUIRE(options.scale.regions.size() == 2U);
    const FactorRegion &sphere = options.scale.regions[0], &box = options.scale.regions[1];
    BOOST_CHECK(sphere.shape == FactorRegion::Shape::sphere);
    BOOST_TEST(sphere.lower == openvdb::Vec3d(0, 1, -2.5));
    BOOST_TEST(sphere.radius == 0.5);
    BOOST_TEST(sphere.factor == 0.25);
    BOOST_CHECK(box.shape == FactorRegion::Shape::box);
    BOOST_TEST(box.lower == openvdb::Vec3d(0, 1, 0));
    BOOST_TEST(box.upper == openvdb::Vec3d(1, 3, 1));
    BOOST_TEST(box.factor == 0);
    BOOST_CHECK_NO_THROW(requireValid(options));
    setOption(options, "element", "cube");
    BOOST_CHECK_EXCEPTION(requireValid(options), InputError,
                          [](const InputError& error) { return names(error, "--scale-field"); });
    setOption(options, "scale-field", "none");
    BOOST_TEST(options.scale.isNone());
    BOOST_CHECK_NO_THROW(requireValid(options));
    for (const char* bad : {"sphere:0,0,0,1", "sphere:0,0,0,-1,1", "sphere:0,0,0,1,9", "box:0,0,0,1,1,1,x",
                            "box:0,0,0,1,1,1,-0.1", "ball:0,0,0,1,1", "sphere:0,0,0,1,1;", ""}) {
        BOOST_CHECK_EXCEPTION(setOption(options, "scale-field", bad), InputError,
                              [](const InputError& error) { return names(error, "--scale-field"); });
    }
}

BOOST_AUTO_TEST_CASE(a_density_is_given_as_text_and_needs_the_guard)
{
    CageOptions options;
    setOption(options, "density", "sphere:0,1,-2.5,0.5,2");
    BOOST_REQUIRE(options.density.regions.size() == 1U);
    BOOST_TEST(options.density.regions[0].factor == 2);
    BOOST_TEST(!options.density.isNone());
    BOOST_TEST(options.scale.isNone());
    BOOST_CHECK_NO_THROW(requireValid(options));
    options.bounding = false;
    BOOST_CHECK_EXCEPTION(requireValid(options), InputError,
                          [](const InputError& error) { return names(error, "--density"); });
    BOOST_CHECK_EXCEPTION(setOption(options, "density", "sphere:1"), InputError, [](const InputError& error) {
        return names(error, "--density") && names(error, "is not a density field");
    });
}

BOOST_AUTO_TEST_CASE(joints_are_read_from_a_file_whose_errors_name_the_line)
{
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "knees.joints";
    const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
    write("# knees\n1 2 3\n\n 0 0 0  0 -2 0 # a bone\n");
    CageOptions options;
    setOption(options, "joints", file.string());
    BOOST_REQUIRE(options.joints.list.size() == 2U);
    BOOST_TEST(options.joints.list[0].place == openvdb::Vec3d(1, 2, 3));
    BOOST_TEST(!options.joints.list[0].axis);
    BOOST_TEST(options.joints.list[1].axis.value() == openvdb::Vec3d(0, -2, 0));
    options.bounding = false;
    BOOST_CHECK_EXCEPTION(requireValid(options), InputError,
                          [](const InputError& error) { return names(error, "--joints"); });
    setOption(options, "joints", "none");
    BOOST_TEST(options.joints.list.empty());
    for (const char* bad : {"1 2 3\n1 2\n", "1 2 3\n1 2 3 1 2 3\n", "1 2 3\n1 2 3 4 5 6 7\n", "1 2 3\nknee 1 2 3\n",
                            "1 2 3\n1 2 nan\n", "1 2 3\n1 2 3 4\n"}) {
        write(bad);
        BOOST_CHECK_EXCEPTION(readJoints(file), IoError, [&](const IoError& error) {
            return names(error, file.string()) && names(error, "line 2");
        });
    }
    write("# nothing\n");
    BOOST_CHECK_THROW(readJoints(file), IoError);
    std::filesystem::remove(file);
    BOOST_CHECK_THROW(readJoints(file), IoError);
}

BOOST_AUTO_TEST_CASE(what_is_not_allowed_is_refused_by_name_value_and_range)
{
    const std::vector<std::pair<std::string, std::string>> bad{
        {"faces", "3"},         {"faces", "1000001"},    {"faces", "4.5"},        {"faces", ""},
        {"faces", "12x"},       {"faces", " 12"},        {"resolution", "7"},     {"resolution", "2049"},
        {"close-radius", "-1"}, {"close-radius", "nan"}, {"close-radius", "inf"}, {"close-radius", "0,03"},
        {"erode-radius", "x"},  {"element", "Cube"},     {"mesh", "quads!"},      {"quad-shape", "1.1"},
        {"merge-angle", "181"}, {"voxelizer", ""},       {"bounding", "maybe"},   {"smooth", "99999999999"},
        {"clearance", "0"},     {"effort", "worst"},     {"parts", ""},           {"resolution", "64.5"},
        {"min-angle", "31"}};
    for (const auto& entry : bad) {
        CageOptions options;
        BOOST_CHECK_EXCEPTION(setOption(options, entry.first, entry.second), InputError, [&](const InputError& error) {
            return names(error, "--" + entry.first) && names(error, "'" + entry.second + "'") &&
                   names(error, "must be");
        });
        BOOST_CHECK(optionValues(options) == optionValues(CageOptions{}));
    }
    CageOptions options;
    BOOST_CHECK_EXCEPTION(setOption(options, "facs", "400"), InputError,
                          [](const InputError& error) { return names(error, "facs") && names(error, "faces"); });
}

BOOST_AUTO_TEST_CASE(fields_set_directly_are_checked_too)
{
    CageOptions options;
    options.closeRadius = std::numeric_limits<double>::quiet_NaN();
    BOOST_CHECK_THROW(requireValid(options), InputError);
    options = {};
    options.erodeRadius = 0.2;
    BOOST_CHECK_EXCEPTION(requireValid(options), InputError,
                          [](const InputError& error) { return names(error, "close radius"); });
    options = {};
    options.faces = 0;
    BOOST_CHECK_THROW(requireValid(options), InputError);
    for (const CageFaces mesh : {CageFaces::triangles, CageFaces::triquad, CageFaces::quads, CageFaces::loops}) {
        options.mesh = mesh;
        options.faces = leastFaces(mesh);
        BOOST_TEST(options.faces == (mesh == CageFaces::triangles ? 4 : 6));
        BOOST_CHECK_NO_THROW(requireValid(options));
        const std::string less = std::to_string(--options.faces);
        BOOST_CHECK_EXCEPTION(requireValid(options), InputError, [&](const InputError& error) {
            return names(error, "--faces: '" + less + "'") && names(error, "must be");
        });
    }
    options.faces = 6;
    options.bounding = false;
    BOOST_CHECK_EXCEPTION(requireValid(options), InputError,
                          [](const InputError& error) { return names(error, "loops") && names(error, "bounding"); });
}

BOOST_AUTO_TEST_SUITE_END()
