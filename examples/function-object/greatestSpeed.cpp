// SPDX-License-Identifier: GPL-3.0-or-later
//
// A function object of your own: prints the greatest speed of the fluid in every window.
// docs/function-objects.md has the line that compiles it.
#include <addToRunTimeSelectionTable.H>
#include <fvMeshFunctionObject.H>
#include <volFields.H>

namespace Foam::functionObjects {

class greatestSpeed : public fvMeshFunctionObject {
 public:
    TypeName("greatestSpeed");

    greatestSpeed(const word& name, const Time& time, const dictionary& entries)
        : fvMeshFunctionObject(name, time, entries) {}

    bool execute() override { return true; }

    bool write() override {
        const auto& U = mesh_.lookupObject<volVectorField>("U");
        Info << "greatest speed at " << mesh_.time().timeName() << ": "
             << gMax(mag(U.primitiveField())()) << endl;
        return true;
    }
};

defineTypeNameAndDebug(greatestSpeed, 0);
addToRunTimeSelectionTable(functionObject, greatestSpeed, dictionary);

}  // namespace Foam::functionObjects
