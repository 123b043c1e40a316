#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include <tools/view/widgets/theme.h>
#include <vdbcage/core/error.h>
#include <view/support/panel.h>

using namespace vdbcage;
using namespace vdbcage::view;
using test::Desk;
using test::Panel;

namespace {

constexpr Modifiers control{false, true, false};

/// By WCAG 2.1, from 1 to 21.
double contrast(const draw::Colour& a, const draw::Colour& b)
{
    const auto luminance = [](const draw::Colour& colour) {
        const auto linear = [](double c) { return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
        return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
    };
    const double first = luminance(a) + 0.05;
    const double second = luminance(b) + 0.05;
    return std::max(first, second) / std::min(first, second);
}

} // namespace

BOOST_AUTO_TEST_SUITE(widgets)

BOOST_AUTO_TEST_CASE(a_click_presses_a_button_once)
{
    Desk desk;
    desk.click("button");
    BOOST_TEST(desk.panel.presses == 1);
    desk.look();
    BOOST_TEST(desk.panel.presses == 1);
    desk.click("button");
    BOOST_TEST(desk.panel.presses == 2);
    desk.click("checkbox");
    BOOST_TEST(desk.panel.checked);
    BOOST_TEST(desk.panel.presses == 2);
}

BOOST_AUTO_TEST_CASE(the_event_says_what_a_double_click_is_not_a_clock)
{
    Desk desk;
    desk.click("button");
    desk.click("button");
    BOOST_TEST(desk.panel.doubleClicks == 0);
    desk.click("button", 2);
    BOOST_TEST(desk.panel.doubleClicks == 1);
    desk.click("button", 3);
    BOOST_TEST(desk.panel.doubleClicks == 1);
    desk.click("button", 1);
    BOOST_TEST(desk.panel.doubleClicks == 1);
    BOOST_TEST(desk.panel.presses == 5);
    // However long ago and far away the press before was.
    for (int i = 0; i < 100; ++i) desk.moveTo("slider", 0.5F);
    desk.click("button", 2);
    BOOST_TEST(desk.panel.doubleClicks == 2);
}

BOOST_AUTO_TEST_CASE(text_fields_take_what_is_typed)
{
    Desk desk;
    desk.click("field");
    BOOST_TEST(desk.widgets.wantsText());
    BOOST_TEST(desk.does(Typed{U'o'}));
    desk.type(U"grs \u00e4\u0436");
    BOOST_TEST(desk.name() == "ogrs \u00e4\u0436");
    desk.press(Key::backspace);
    desk.press(Key::left);
    desk.press(Key::left);
    desk.press(Key::backspace);
    desk.type(U"e");
    BOOST_TEST(desk.name() == "ogre \u00e4");
    desk.press(Key::a, control);
    desk.type(U"x");
    BOOST_TEST(desk.name() == "x");
    desk.press(Key::enter);
    BOOST_TEST(!desk.widgets.wantsText());
    BOOST_TEST(!desk.does(Typed{U'y'}));
    BOOST_TEST(desk.name() == "x");
    BOOST_TEST((desk.widgets.pointerShape() == PointerShape::text));
    desk.moveTo("button");
    BOOST_TEST((desk.widgets.pointerShape() == PointerShape::arrow));
}

BOOST_AUTO_TEST_CASE(tab_begins_no_typing_and_goes_on_with_it)
{
    Desk desk;
    desk.click("button");
    for (int i = 0; i < 3; ++i) {
        BOOST_TEST(!desk.does(KeyDown{Key::tab}));
        desk.does(KeyUp{Key::tab});
        BOOST_TEST(!desk.widgets.wantsText());
    }
    desk.click("field");
    desk.type(U"ogre");
    desk.press(Key::tab); // to the number of the slider
    BOOST_TEST(desk.widgets.wantsText());
    desk.type(U"40");
    desk.press(Key::enter);
    BOOST_TEST(desk.panel.amount == 40);
    BOOST_TEST(desk.name() == "ogre");
}

BOOST_AUTO_TEST_CASE(a_double_click_selects_a_word_to_type_over)
{
    Desk desk;
    desk.click("field");
    desk.type(U"ogre");
    desk.click("field");
    desk.click("field", 2);
    desk.type(U"bunny");
    BOOST_TEST(desk.name() == "bunny");
}

BOOST_AUTO_TEST_CASE(keys_count_as_often_as_they_go_down)
{
    Desk desk;
    desk.press(Key::del);
    BOOST_TEST(desk.panel.deletes == 1);
    // One that is held does not repeat by itself.
    desk.does(KeyDown{Key::del});
    for (int i = 0; i < 5; ++i) desk.look();
    BOOST_TEST(desk.panel.deletes == 2);
    // The keyboard repeats it.
    desk.does(KeyDown{Key::del});
    desk.does(KeyDown{Key::del});
    BOOST_TEST(desk.panel.deletes == 4);
    desk.does(KeyUp{Key::del});
    BOOST_TEST(desk.panel.deletes == 4);
}

BOOST_AUTO_TEST_CASE(a_slider_follows_many_moves_of_one_drag)
{
    Desk desk;
    desk.moveTo("slider", 0.2F);
    desk.does(ButtonDown{});
    float before = desk.panel.amount;
    for (int i = 1; i <= 30; ++i) {
        BOOST_TEST(desk.moveTo("slider", 0.2F + 0.02F * static_cast<float>(i)));
        BOOST_TEST(desk.panel.amount > before);
        before = desk.panel.amount;
    }
    // Beyond its end, and beyond the window.
    BOOST_TEST(desk.does(PointerMoved{Panel::width + 500.0, -40}));
    BOOST_TEST(desk.panel.amount == 100);
    desk.does(ButtonUp{});
    desk.moveTo("slider", 0.2F);
    BOOST_TEST(desk.panel.amount == 100);
}

BOOST_AUTO_TEST_CASE(a_popup_can_be_chosen_from_by_the_next_event)
{
    Desk desk;
    desk.click("combo");
    desk.click("thorough");
    BOOST_TEST(desk.panel.choice == 2);
}

BOOST_AUTO_TEST_CASE(keys_are_a_popups_only_while_it_is_open)
{
    Desk desk;
    BOOST_TEST(!desk.does(KeyDown{Key::down}));
    desk.does(KeyUp{Key::down});
    const Drawing closed = desk.widgets.drawing();
    desk.click("combo");
    BOOST_TEST(desk.widgets.wantsKeyboard());
    BOOST_TEST(desk.does(KeyDown{Key::escape}));
    BOOST_TEST(!desk.widgets.wantsKeyboard());
    desk.does(KeyUp{Key::escape});
    desk.does(PointerLeft{});
    BOOST_TEST((desk.widgets.drawing() == closed));
    BOOST_TEST(!desk.does(KeyDown{Key::escape}));
    desk.does(KeyUp{Key::escape});

    desk.click("combo");
    desk.press(Key::down);
    desk.press(Key::down);
    desk.press(Key::enter);
    BOOST_TEST(desk.panel.choice == 2);
    BOOST_TEST(!desk.widgets.wantsKeyboard());
}

BOOST_AUTO_TEST_CASE(events_outside_of_panels_are_for_what_is_behind)
{
    Desk desk;
    BOOST_TEST(desk.moveTo("button"));
    BOOST_TEST(desk.widgets.wantsPointer());
    BOOST_TEST(desk.does(WheelTurned{0, 1}));
    BOOST_TEST(!desk.does(PointerMoved{350, 410}));
    BOOST_TEST(!desk.widgets.wantsPointer());
    BOOST_TEST(!desk.does(ButtonDown{}));
    // What was begun behind goes on there.
    BOOST_TEST(!desk.moveTo("button"));
    BOOST_TEST(!desk.does(ButtonUp{}));
    BOOST_TEST(desk.panel.presses == 0);
    BOOST_TEST(!desk.does(PointerLeft{}));
    // The press that closes a popup does nothing else.
    desk.click("combo");
    desk.does(PointerMoved{350, 410});
    BOOST_TEST(desk.does(ButtonDown{}));
    desk.does(ButtonUp{});
    BOOST_TEST(!desk.does(ButtonDown{}));
}

BOOST_AUTO_TEST_CASE(the_same_events_give_the_same_drawing)
{
    Desk first;
    Desk second;
    useAll(first);
    useAll(second);
    BOOST_TEST(!first.widgets.drawing().batches.empty());
    BOOST_TEST((first.widgets.drawing() == second.widgets.drawing()));
    second.moveTo("thorough");
    BOOST_TEST((first.widgets.drawing() != second.widgets.drawing()));
}

BOOST_AUTO_TEST_CASE(the_version_tells_whether_to_draw_again)
{
    Desk desk;
    std::uint64_t version = desk.widgets.version();
    BOOST_TEST(version > 0U);
    desk.look();
    desk.does(PointerMoved{350, 410});
    desk.does(KeyDown{Key::a});
    BOOST_TEST(desk.widgets.version() == version);
    desk.moveTo("button");
    BOOST_TEST(desk.widgets.version() != version);
    version = desk.widgets.version();
    // What the panel shows changed by itself. The cursor of a field does not blink.
    desk.panel.checked = true;
    desk.look();
    BOOST_TEST(desk.widgets.version() != version);
    desk.click("field");
    version = desk.widgets.version();
    for (int i = 0; i < 10; ++i) desk.look();
    BOOST_TEST(desk.widgets.version() == version);
}

BOOST_AUTO_TEST_CASE(a_drawing_is_settled_after_each_event)
{
    Desk desk;
    const auto isSettled = [&desk] {
        const std::uint64_t version = desk.widgets.version();
        for (int i = 0; i < 3; ++i) desk.look();
        return desk.widgets.version() == version;
    };
    BOOST_TEST(isSettled());
    for (const char* where : {"combo", "fair", "field", "slider", "button", "checkbox"}) {
        desk.moveTo(where);
        BOOST_TEST(isSettled(), where);
        desk.does(ButtonDown{});
        BOOST_TEST(isSettled(), where);
        desk.does(ButtonUp{});
        BOOST_TEST(isSettled(), where);
    }
}

BOOST_AUTO_TEST_CASE(layouts_of_what_never_settles_are_counted)
{
    Widgets widgets(1);
    int builds = 0;
    const auto build = [&builds] {
        ImGui::Begin("Time");
        ImGui::Text("%d", ++builds);
        ImGui::End();
    };
    widgets.layOut(nullptr, 100, 100, build);
    BOOST_TEST(builds == Widgets::mostLayouts);
}

BOOST_AUTO_TEST_CASE(several_widgets_live_side_by_side)
{
    ImGuiContext* const before = ImGui::GetCurrentContext();
    auto first = std::make_unique<Desk>();
    Desk second;
    first->click("field");
    second.click("checkbox");
    first->type(U"a");
    second.click("button");
    first->type(U"b");
    BOOST_TEST(first->name() == "ab");
    BOOST_TEST(!first->panel.checked);
    BOOST_TEST(second.panel.checked);
    BOOST_TEST(second.panel.presses == 1);
    BOOST_TEST(ImGui::GetCurrentContext() == before);
    first.reset();
    BOOST_TEST(ImGui::GetCurrentContext() == before);
    second.click("button");
    BOOST_TEST(second.panel.presses == 2);
}

BOOST_AUTO_TEST_CASE(an_exception_of_the_panels_comes_out_and_leaves_them_usable)
{
    Desk desk;
    const Drawing drawn = desk.widgets.drawing();
    const auto throwing = [&desk] {
        desk.panel.build();
        ImGui::Begin("Cage");
        ImGui::BeginGroup();
        ImGui::PushID("part");
        throw std::runtime_error("no cage");
    };
    BOOST_CHECK_THROW(desk.widgets.layOut(nullptr, Panel::width, Panel::height, throwing), std::runtime_error);
    BOOST_TEST((desk.widgets.drawing() == drawn));
    desk.click("button");
    BOOST_TEST(desk.panel.presses == 1);
}

BOOST_AUTO_TEST_CASE(cut_text_goes_to_the_clipboard_that_was_given)
{
    const auto fill = [](Panel& panel) { std::copy_n("ogre", 5, panel.name.begin()); };
    std::string text;
    Panel panel;
    fill(panel);
    Widgets widgets(1, {[&text] { return text; }, [&text](const std::string& copied) { text = copied; }});
    const auto does = [&](auto what, const Modifiers& modifiers = {}) {
        const InputEvent event{what, modifiers};
        widgets.layOut(&event, Panel::width, Panel::height, [&panel] { panel.build(); });
    };
    does(PointerLeft{});
    const Panel::Place& field = panel.places.at("field");
    does(PointerMoved{field.left + 10.0, (field.top + field.bottom) / 2});
    does(ButtonDown{});
    does(ButtonUp{});
    for (const Key key : {Key::a, Key::c, Key::v, Key::v}) {
        does(KeyDown{key}, control);
        does(KeyUp{key}, control);
    }
    BOOST_TEST(text == "ogre");
    BOOST_TEST(std::string(panel.name.data()) == "ogreogre");

    // Without one, text stays among these widgets.
    Desk desk;
    fill(desk.panel);
    desk.click("field");
    desk.press(Key::a, control);
    desk.press(Key::x, control);
    BOOST_TEST(desk.name().empty());
    desk.press(Key::v, control);
    BOOST_TEST(desk.name() == "ogre");
    BOOST_TEST(text == "ogre");
}

BOOST_AUTO_TEST_CASE(a_scale_makes_everything_larger)
{
    const auto heightOf = [](float factor) {
        Widgets widgets(factor);
        float height = 0;
        widgets.layOut(nullptr, 1000, 1000, [&] {
            ImGui::Begin("Cage");
            BOOST_TEST(view::scale() == factor);
            ImGui::Button("Make");
            height = ImGui::GetItemRectSize().y;
            ImGui::End();
        });
        return height;
    };
    BOOST_TEST(heightOf(2) == 2 * heightOf(1));
    for (const float bad : {0.0F, -1.0F, 9.0F, std::numeric_limits<float>::quiet_NaN()}) {
        BOOST_CHECK_THROW(Widgets{bad}, InputError);
    }
}

BOOST_AUTO_TEST_CASE(a_window_of_no_size_shows_nothing)
{
    Widgets widgets(1);
    Panel panel;
    widgets.layOut(nullptr, 0, 0, [&panel] { panel.build(); });
    BOOST_TEST(widgets.drawing().batches.empty());
}

BOOST_AUTO_TEST_CASE(text_can_be_read_on_what_it_stands_on)
{
    constexpr double least = 4.5;
    using namespace theme;
    for (const draw::Colour& ground :
         {title, panel, popup, field, fieldHovered, fieldActive, theme::button, buttonHovered, buttonActive, accentFill,
          accentFillHovered, accentFillActive, selected}) {
        BOOST_TEST(contrast(theme::text, ground) >= least);
    }
    for (const draw::Colour& ground : {title, panel, popup, field}) {
        for (const draw::Colour& colour : {mutedText, accent, good, warning, bad}) {
            BOOST_TEST(contrast(colour, ground) >= least);
        }
    }
    // Handles, which are no text.
    BOOST_TEST(contrast(accentFillHovered, field) >= 3);
}

BOOST_AUTO_TEST_SUITE_END()
