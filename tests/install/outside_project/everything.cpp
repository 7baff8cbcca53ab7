// Every installed header compiles by itself: installed_headers.inc is the list, made by install_test.sh.
#include <installed_headers.inc>

int main() {}
