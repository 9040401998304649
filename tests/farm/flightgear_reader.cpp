// Reads a file of `awan particles -o FILE.xml` by SimGear, FlightGear's library, and goes through it as FlightGear's
// FGClouds::buildLayer, buildCloud and add3DCloud do (2020.3). A line each: the layers and how many heaps a box of it
// makes on average, and of every placed heap where its middle is and how wide and high it is, in metres.
//   reader FILE
#include <cmath>
#include <iostream>
#include <simgear/misc/sg_path.hxx>
#include <simgear/props/props.hxx>
#include <simgear/props/props_io.hxx>

namespace {

// What SGNewCloud asks of a definition; 0: it would use a default.
bool is_whole(const SGPropertyNode* of) {
    for (const char* name :
         {"cloud-width-m", "cloud-height-m", "sprite-width-m", "sprite-height-m"}) {
        const std::string least = std::string("min-") + name, most = std::string("max-") + name;
        if (!(of->getFloatValue(least.c_str(), 0) > 0)) return false;
        if (of->getFloatValue(most.c_str(), 0) < of->getFloatValue(least.c_str(), 0)) return false;
    }
    for (const char* name : {"bottom", "middle", "top", "shade"}) {
        const float factor =
            of->getFloatValue(("min-" + std::string(name) + "-lighting-factor").c_str(), 0);
        if (!(factor > 0 && factor <= 1)) return false;
    }
    return of->getIntValue("num-sprites", 0) > 0 && of->getIntValue("num-textures-x", 0) == 4 &&
           of->getBoolValue("height-map-texture", false) &&
           of->getFloatValue("alpha-factor", 0) > 0 &&
           !std::string(of->getStringValue("texture", "")).empty();
}

int failed(const std::string& what) {
    std::cerr << "reader: " << what << "\n";
    return 1;
}

}  // namespace

int main(int, char** arguments) {
    SGPropertyNode_ptr root = new SGPropertyNode;
    readProperties(SGPath(arguments[1]), root);
    SGPropertyNode* const clouds = root->getNode("clouds");
    SGPropertyNode* const boxes = root->getNode("boxes");
    SGPropertyNode* const layers = root->getNode("layers");
    SGPropertyNode* const placed = root->getNode("placed");
    if (!clouds || !boxes || !layers || !placed) return failed("a part is missing");
    for (int l = 0; l < layers->nChildren(); ++l) {
        SGPropertyNode* const layer = layers->getChild(l);
        double heaps = 0;
        for (int c = 0; c < layer->nChildren(); ++c) {
            SGPropertyNode* const cloud = layer->getChild(c);
            if (std::string(cloud->getName()) != "cloud") continue;
            SGPropertyNode* const kind = boxes->getChild(cloud->getStringValue("name"));
            if (!kind) return failed("no box is called as the layer says");
            for (int b = 0; b < kind->nChildren(); ++b) {
                SGPropertyNode* const box = kind->getChild(b);
                SGPropertyNode* const definition = clouds->getChild(box->getStringValue("type"));
                if (!definition || !is_whole(definition)) return failed("a box has no whole cloud");
                if (box->getDoubleValue("width", -1) < 0 || box->getDoubleValue("height", -1) < 0)
                    return failed("a box has no size");
                heaps += box->getDoubleValue("count", 0);
            }
        }
        std::cout << "layer " << layer->getName() << " " << heaps << "\n";
    }
    for (int i = 0; i < placed->nChildren(); ++i) {
        SGPropertyNode* const cloud = placed->getChild("cloud", i);
        if (!cloud || !is_whole(cloud)) return failed("a placed cloud is not whole");
        if (cloud->getIntValue("index", 0) != i + 1) return failed("an index is not its own");
        std::cout << "placed " << cloud->getFloatValue("x-offset-m", 1e9f) << " "
                  << cloud->getFloatValue("y-offset-m", 1e9f) << " "
                  << cloud->getFloatValue("alt-ft", 1e9f) * 0.3048 << " "
                  << cloud->getFloatValue("min-cloud-width-m") << " "
                  << cloud->getFloatValue("min-cloud-height-m") << "\n";
    }
    return 0;
}
