#include "player.h"
int main(void){return 0;}
