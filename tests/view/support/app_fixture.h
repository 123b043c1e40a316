#pragma once

#include <memory>
#include <string>
#include <vector>

#include <boost/test/unit_test.hpp>

#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tools/view/app.h>
#include <tools/view/script.h>
#include <vdbcage/gl/offscreen.h>
#include <vdbcage/mesh/mesh_io.h>
#include <view/support/orders.h>

namespace vdbcage::test {

/// Makes a ball, at once.
class BallMaker : public view::CageMaker {
public:
    view::CageResultPtr make(const view::Job& job, Interrupter&) override
    {
        view::CageResult result;
        result.order = job.order;
        const openvdb::BBoxd box = boundingBox(job.order.model->mesh);
        result.cage = sphere({0, 0, 0}, 1.5 * box.max().y(), 5);
        result.report.check.triangles = result.cage.triangles.size();
        result.report.check.quads = result.cage.quads.size();
        if (job.intermediates) result.intermediates = std::make_shared<const view::Intermediates>();
        return std::make_shared<const view::CageResult>(std::move(result));
    }
};

struct AppFixture {
    TemporaryFolder folder;
    gl::OffscreenContext context;
    gl::OffscreenContext::Current current = context.makeCurrent();
    std::vector<std::string> recorded;
    std::vector<std::string> files;

    AppFixture()
    {
        for (int i = 1; i <= 3; ++i) {
            files.push_back((folder / ("model " + std::to_string(i) + ".obj")).string());
            writeMesh(sphere({0, 0, 0}, i, 6), files.back());
        }
    }

    view::AppSetup setup(bool fake = true)
    {
        view::AppSetup setup;
        setup.width = 1100;
        setup.height = 760;
        setup.isSoftware = true;
        if (fake) setup.maker = std::make_unique<BallMaker>();
        setup.record = [this](const std::string& line) { recorded.push_back(line); };
        return setup;
    }

    void run(view::App& app, const std::vector<std::string>& lines) const
    {
        for (const std::string& line : lines) {
            BOOST_TEST_CONTEXT(line) runLine(app, line);
        }
    }
};

inline bool samePicture(const draw::Picture& a, const draw::Picture& b)
{
    return a.width == b.width && a.height == b.height && a.rgb == b.rgb;
}

} // namespace vdbcage::test
