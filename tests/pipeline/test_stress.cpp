#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <set>

#include <support/temporary_folder.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

#include "stress_models.h"

using namespace vdbcage;
namespace data = boost::unit_test::data;

namespace {

const std::vector<test::StressModel>& models()
{
    static const std::vector<test::StressModel> list = test::stressModels();
    return list;
}

} // namespace

BOOST_AUTO_TEST_SUITE(stress)

BOOST_AUTO_TEST_CASE(there_are_more_than_300_models_with_names_of_their_own)
{
    std::set<std::string> names;
    for (const test::StressModel& model : models()) names.insert(model.name);
    BOOST_TEST(names.size() > 300U);
    BOOST_TEST(names.size() == models().size());
}

// Coarse voxels and little effort, so that all models fit in a minute: what must hold is the same at any.
BOOST_DATA_TEST_CASE(every_model_gets_a_certified_cage, data::make(models()) ^ data::xrange(models().size()), model,
                     number)
{
    const int faceCounts[] = {12, 20, 50, 100};
    CageOptions options;
    options.resolution = 12;
    options.effort = Effort::fast;
    options.faces = faceCounts[number % std::size(faceCounts)];
    if (options.faces == 12) options.parts = CageParts::merge;
    Pipeline made(model.mesh);
    const Mesh& cage = made.run(options);
    BOOST_TEST(faceCount(cage) <= static_cast<std::size_t>(options.faces));
    BOOST_TEST(made.report().check.bounding());
    // The box is certified too: if it could always be the way out, a guard that allows anything would not be noticed.
    // At 12 faces it can be, where a flat model's smallest angles allow nothing else.
    if (options.faces > 12) BOOST_CHECK(made.report().start != CageStart::box);

    const test::TemporaryFolder folder;
    writeMesh(cage, folder / "cage.off");
    CheckOptions exactOnly;
    exactOnly.measure = false;
    BOOST_TEST(checkCage(readMesh(folder / "cage.off"), model.mesh, exactOnly).bounding());
}

BOOST_AUTO_TEST_SUITE_END()
