#include <tools/cli/commands.h>

#include <vdbcage/core/error.h>

namespace vdbcage::cli {

const std::vector<Command>& commands()
{
    static const std::vector<Command> all{
        {"make",
         "make a cage for a model",
         runMake,
         "One cage bounds all models. They may be open, self-intersecting, badly oriented or in many parts. Gaps "
         "are bridged by a closing of voxels. Its surface is shrunk, decimated and tightened. Unless "
         "--bounding is off, the cage is written only if it is proved to be valid and to bound every model. It is the "
         "same for any number of threads. Lengths are fractions of the models' longest side, but for places, which are "
         "in "
         "their coordinates: REGION is sphere:X,Y,Z,RADIUS,TIMES or box:X,Y,Z,X,Y,Z,TIMES, and a joints file has a "
         "line "
         "X Y Z for a point, X Y Z X Y Z for a bone.",
         {{"A cage of at most 400 triangles, as tight as it can be:", "vdbcage make bishop.obj -o cage.obj"},
          {"Quads in loops around limbs, the same on both sides, with a picture:",
           "vdbcage make creature.obj -o loops.obj --mesh loops --symmetry auto --picture loops.png"},
          {"Sooner, with a report for programs:",
           "vdbcage make bishop.obj -o fast.obj --effort fast --report fast.json"}}},
        {"check",
         "examine a cage against its model",
         runCheck,
         "",
         {{"Is it a valid cage around the whole model?", "vdbcage check cage.obj bishop.obj"}}},
        {"render",
         "draw models, cages and volumes into a picture",
         runRender,
         "",
         {{"A model in its cage, and beside it the model alone:",
           "vdbcage render bishop.obj cage.obj / bishop.obj -o picture.png"}}},
        {"bind",
         "compute how a cage moves a model",
         runBind,
         "",
         {{"Once, for many poses:", "vdbcage bind cage.obj bishop.obj -o weights.npy --coordinates mlc"}}},
        {"deform",
         "move a model by its posed cage",
         runDeform,
         "",
         {{"One pose, with weights of bind:",
           "vdbcage deform cage.obj posed.obj bishop.obj -o moved.obj --weights weights.npy"},
          {"All families of coordinates beside each other, in a picture and in numbers:",
           "vdbcage deform cage.obj posed.obj bishop.obj -o families.png --compare"}}},
        {"fit",
         "move a drawn cage to where it bounds",
         runFit,
         "The cage may cut the model, lie inside of it, and cross itself. It keeps its points, faces and their order: "
         "quads stay quads, and groups, materials and texture coordinates of an OBJ stay as they are. It is certified "
         "as by check.",
         {{"A cage of an earlier version of the model, moved no farther than it has to be:",
           "vdbcage fit cage.obj bishop.obj -o fitted.obj --tight 0"}}},
        {"repair",
         "mend a cage that was made elsewhere",
         runRepair,
         "A valid cage comes back as it came. Points that were pulled through other faces go back between their "
         "neighbours. Parts that overlap become one. What is written is examined as by check, but for the model. Needs "
         "a vdbcage that was built with its GPL part (VDBCAGE_WITH_CGAL_GPL).",
         {{"Closed, oriented and free of self-intersections, if it can be:", "vdbcage repair cage.obj -o mended.obj"}}},
        {"jobs",
         "print a command for each of many models, for farms",
         runJobs,
         "With --fit the commands, and the options, are those of fit: each moves CAGE, a template, to where it bounds "
         "the model.",
         {{"Cages for two models, one after the other:",
           "vdbcage jobs bishop.obj creature.obj -o cages > jobs.txt && sh jobs.txt"},
          {"One drawn cage for two models:",
           "vdbcage jobs --fit cage.obj bishop.obj moved.obj -o fits > fits.txt && sh fits.txt"}}},
        {"report",
         "list the results of many jobs",
         runReport,
         "",
         {{"On the terminal and as a page:", "vdbcage report cages --html cages.html"}}},
        {"man", "print a manual page", runMan, "", {{"To read it:", "vdbcage man make | man -l -"}}},
        {"completion",
         "print a shell's completion of commands",
         runCompletion,
         "",
         {{"For this bash; in ~/.bashrc for all:", "source <(vdbcage completion bash)"},
          {"For zsh, in ~/.zshrc after compinit:", "source <(vdbcage completion zsh)"},
          {"For fish:", "vdbcage completion fish > ~/.config/fish/completions/vdbcage.fish"}}},
    };
    return all;
}

std::vector<std::string> commandNames()
{
    std::vector<std::string> names;
    for (const Command& command : commands()) names.push_back(command.name);
    return names;
}

const Command& commandNamed(const std::string& name)
{
    for (const Command& command : commands()) {
        if (command.name == name) return command;
    }
    throw InputError("there is no command '" + name + "'" + didYouMean(name, commandNames()) + " (see vdbcage --help)");
}

CommandFacts describe(const Command& command)
{
    CommandFacts result;
    command.run({{}, [&](const CommandFacts& facts) { result = facts; }});
    return result;
}

} // namespace vdbcage::cli
