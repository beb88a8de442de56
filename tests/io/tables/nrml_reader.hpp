#pragma once
/// Fragility functions of an NRML text as they stand there, in the order and the units of the text: a reader that
/// shares nothing with what writes them.

#include <pugixml.hpp>

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace stylobate {

struct NrmlState {
    std::string name;
    double mean = 0, stddev = 0;     ///< of the intensity, of a continuous function
    std::vector<double> probability; ///< at each intensity of a discrete function
};

struct NrmlFunction {
    std::string id, format, shape, measure;
    double least = 0, most = 0;    ///< range of a continuous function
    std::vector<double> intensity; ///< of a discrete function
    std::vector<NrmlState> states;
};

struct NrmlModel {
    std::string id, description;
    std::vector<std::string> limit_states;
    std::vector<NrmlFunction> functions;
};

/// The words of a text as numbers or texts. @throws std::runtime_error where one is not wholly read
template <class T>
std::vector<T> nrml_words(const std::string& text)
{
    std::vector<T> values;
    std::istringstream words(text);
    for (T value; words >> value;)
        values.push_back(value);
    if (!words.eof())
        throw std::runtime_error("'" + text + "' is not a list of values");
    return values;
}

/// @throws std::runtime_error where the text is no XML or has another root
inline NrmlModel read_nrml(const std::string& text)
{
    pugi::xml_document document;
    const pugi::xml_node nrml = document.load_string(text.c_str()) ? document.child("nrml") : pugi::xml_node();
    if (std::string(nrml.attribute("xmlns").value()) != "http://openquake.org/xmlns/nrml/0.5")
        throw std::runtime_error("no NRML 0.5");
    const pugi::xml_node node = nrml.child("fragilityModel");
    NrmlModel model{.id = node.attribute("id").value(),
                    .description = node.child("description").text().get(),
                    .limit_states = nrml_words<std::string>(node.child("limitStates").text().get()),
                    .functions = {}};
    for (const pugi::xml_node child : node.children("fragilityFunction")) {
        const pugi::xml_node imls = child.child("imls");
        NrmlFunction function{.id = child.attribute("id").value(),
                              .format = child.attribute("format").value(),
                              .shape = child.attribute("shape").value(),
                              .measure = imls.attribute("imt").value(),
                              .least = imls.attribute("minIML").as_double(),
                              .most = imls.attribute("maxIML").as_double(),
                              .intensity = nrml_words<double>(imls.text().get()),
                              .states = {}};
        for (const char* element : {"params", "poes"})
            for (const pugi::xml_node state : child.children(element))
                function.states.push_back({.name = state.attribute("ls").value(),
                                           .mean = state.attribute("mean").as_double(),
                                           .stddev = state.attribute("stddev").as_double(),
                                           .probability = nrml_words<double>(state.text().get())});
        model.functions.push_back(std::move(function));
    }
    return model;
}

} // namespace stylobate
