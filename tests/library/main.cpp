// example SCENE PICTURE.png: what the library needs to make a cloud.
#include <awan/awan.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace cloud = awan::library;

int main(int count, char** arguments) {
    if (count != 3) {
        std::cerr << "usage: example SCENE PICTURE.png\n";
        return 2;
    }
    std::ifstream file(arguments[1], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    try {
        const cloud::Scene scene = cloud::read_scene(text).with("/image/width", "96").with("/image/height", "72");
        const cloud::Picture picture = cloud::render(scene);
        std::ofstream(arguments[2], std::ios::binary) << picture.png();
        std::cout << "awan " << cloud::version() << ": " << cloud::particles(scene).size() << " particles, "
                  << picture.width() << "x" << picture.height() << " by " << picture.rung() << ", error "
                  << picture.error() << "\n";
    } catch (const cloud::Error& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
